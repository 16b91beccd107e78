#include <welkin/sh/convolution.h>

#include <cmath>
#include <numbers>

namespace welkin {

// A_1 = 2 pi/3, A_l = 0 for other odd l, and for even l
//   A_l = 2 pi (-1)^(l/2 - 1) / ((l + 2)(l - 1)) * l! / (2^l ((l/2)!)^2),
// whose last factor, the central binomial over 2^l, is built up by c_l = c_(l-2) (l - 1)/l.
std::vector<double> cosine_lobe(int max_degree) {
  std::vector<double> factors(max_degree + 1);
  double binomial = 1, sign = -1;
  for (int l = 0; l <= max_degree; l += 2) {
    if (l > 0) {
      binomial *= (l - 1.0) / l;
      sign = -sign;
    }
    factors[l] = 2 * std::numbers::pi * sign * binomial / ((l + 2.0) * (l - 1.0));
  }
  if (max_degree >= 1) factors[1] = 2 * std::numbers::pi / 3;
  return factors;
}

ShCoefficients convolve(const ShCoefficients& coefficients, std::span<const double> factors) {
  ShCoefficients result(coefficients.max_degree, coefficients.channels);
  for (int l = 0; l <= result.max_degree && l < static_cast<int>(factors.size()); ++l)
    for (std::size_t i = sh_index(l, -l) * result.channels; i < sh_index(l + 1, -l - 1) * result.channels;
         ++i)
      result.values[i] = factors[l] * coefficients.values[i];
  return result;
}

}  // namespace welkin
