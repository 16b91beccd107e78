#include <welkin/sh/ring_transform.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace welkin {

RingTransform::RingTransform(int max_degree, int azimuths)
    : max_degree_(max_degree),
      azimuths_(azimuths),
      cosines_(azimuths),
      sines_(azimuths),
      legendre_(sh_count(max_degree)) {
  for (int k = 0; k < azimuths; ++k) {
    cosines_[k] = std::cos(2 * std::numbers::pi * k / azimuths);
    sines_[k] = std::sin(2 * std::numbers::pi * k / azimuths);
  }
}

void RingTransform::set_ring(double z) {
  const double r = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
  evaluate_sh_basis({r, 0, z}, max_degree_, legendre_);
}

void RingTransform::synthesize(const ShCoefficients& coefficients, std::vector<double>& values) {
  assert(coefficients.max_degree <= max_degree_);
  const int degree = coefficients.max_degree, channels = coefficients.channels;
  orders_.assign(static_cast<std::size_t>(2 * degree + 1) * channels, 0);
  for (int l = 0; l <= degree; ++l)
    for (int m = -l; m <= l; ++m)
      for (int c = 0; c < channels; ++c)
        orders_[(m + degree) * channels + c] +=
            legendre_[sh_index(l, std::abs(m))] * coefficients.values[sh_index(l, m) * channels + c];
  values.assign(static_cast<std::size_t>(azimuths_) * channels, 0);
  for (int k = 0; k < azimuths_; ++k)
    for (int m = -degree; m <= degree; ++m) {
      const int turns = static_cast<int>(static_cast<long long>(k) * std::abs(m) % azimuths_);
      const double wave = m < 0 ? sines_[turns] : cosines_[turns];
      for (int c = 0; c < channels; ++c)
        values[k * channels + c] += wave * orders_[(m + degree) * channels + c];
    }
}

void RingTransform::add_analysis(std::span<const double> values, double weight,
                                 ShCoefficients& coefficients) {
  assert(coefficients.max_degree <= max_degree_);
  const int degree = coefficients.max_degree, channels = coefficients.channels;
  orders_.assign(static_cast<std::size_t>(2 * degree + 1) * channels, 0);
  for (int m = -degree; m <= degree; ++m)
    for (int k = 0; k < azimuths_; ++k) {
      const int turns = static_cast<int>(static_cast<long long>(k) * std::abs(m) % azimuths_);
      const double wave = weight * (m < 0 ? sines_[turns] : cosines_[turns]);
      for (int c = 0; c < channels; ++c)
        orders_[(m + degree) * channels + c] += wave * values[k * channels + c];
    }
  for (int l = 0; l <= degree; ++l)
    for (int m = -l; m <= l; ++m)
      for (int c = 0; c < channels; ++c)
        coefficients.values[sh_index(l, m) * channels + c] +=
            legendre_[sh_index(l, std::abs(m))] * orders_[(m + degree) * channels + c];
}

}  // namespace welkin
