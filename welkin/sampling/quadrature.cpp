#include <welkin/sampling/quadrature.h>

#include <cmath>
#include <numbers>

namespace welkin {

QuadratureRule gauss_legendre(int count) {
  QuadratureRule rule{std::vector<double>(count), std::vector<double>(count)};
  for (int i = 0; i < (count + 1) / 2; ++i) {
    // Tricomi's start is good to O(count^-4); Newton doubles the digits each time.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double previous = 1, current = x;
      for (int l = 2; l <= count; ++l) {
        const double next = ((2 * l - 1) * x * current - (l - 1) * previous) / l;
        previous = current;
        current = next;
      }
      slope = count * (x * current - previous) / (x * x - 1);
      const double step = current / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    if (2 * i + 1 == count) x = 0;
    const double weight = 2 / ((1 - x * x) * slope * slope);
    rule.nodes[i] = -x;
    rule.nodes[count - 1 - i] = x;
    rule.weights[i] = rule.weights[count - 1 - i] = weight;
  }
  return rule;
}

// The remainder of n-point Gauss-Legendre on [-1, 1] is 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)^3) f^(2n)(xi)
// (Abramowitz & Stegun 25.4.30); for cos(kappa s) the derivative is at most kappa^2n, and the interval has length 2.
double gauss_legendre_error(int count, double kappa) {
  const double n = count;
  const double log_factor =
      2 * n * std::log(2.0) + 4 * std::lgamma(n + 1) - std::log(2 * n + 1) - 3 * std::lgamma(2 * n + 1);
  return std::exp(log_factor + 2 * n * std::log(kappa));
}

}  // namespace welkin
