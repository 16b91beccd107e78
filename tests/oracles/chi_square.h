#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

// Pearson's goodness-of-fit test: do counted samples follow a density?

namespace welkin::oracle {

/// Q(a, x), the upper regularised incomplete gamma function, a > 0, x >= 0: its series below a + 1, Lentz's continued
/// fraction above (both in Abramowitz & Stegun 1964, 6.5.29 and 6.5.31).
inline double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-16; n += 1) sum += term *= x / n;
    return 1 - scale * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 100000; ++i) {
    const double an = i * (a - i);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return scale * h;
}

struct ChiSquare {
  double statistic = 0;
  int degrees_of_freedom = 0;
  double p = 0;  ///< the chance of a statistic as large as this if the counts do follow the expectation
};

/// Bins where fewer than `least` counts are expected are pooled with each other, smallest first. A sample where nothing at
/// all is expected gives p = 0.
inline ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected,
                            double least = 5) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  ChiSquare result;
  double pooled_observed = 0, pooled_expected = 0;
  int bins = 0;
  for (const std::size_t i : order) {
    if (expected[i] == 0 && observed[i] > 0) return {INFINITY, 1, 0};
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < least) continue;
    const double off = pooled_observed - pooled_expected;
    result.statistic += off * off / pooled_expected;
    pooled_observed = pooled_expected = 0;
    ++bins;
  }
  result.degrees_of_freedom = std::max(bins - 1, 1);
  result.p = upper_gamma(result.degrees_of_freedom / 2.0, result.statistic / 2);
  return result;
}

/// The smallest p that a run of `tests` independent tests may show when together they are to fail by chance with
/// probability `significance` (Sidak 1967).
inline double sidak_threshold(double significance, int tests) {
  return 1 - std::pow(1 - significance, 1.0 / tests);
}

}  // namespace welkin::oracle
