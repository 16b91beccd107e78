#include <welkin/sh/spectrum.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/sh/basis.h>

namespace welkin {

Spectrum::Spectrum(int degree, int channel_count)
    : max_degree(degree),
      channels(channel_count),
      values(static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 2) / 2 *
             static_cast<std::size_t>(channel_count)) {}

// The basis functions have their pole at z, the map at +Y: the map's (x, y, z) is the basis' (x, z, y), which keeps
// phi = atan2(z, x) of the map. Y_lm = sqrt2 P_lm cos, Y_l-m = sqrt2 P_lm sin, so the complex term 2 Re(a P e^(i m
// phi)) is sqrt2 (Re a Y_lm - Im a Y_l-m).
std::vector<double> evaluate(const Spectrum& spectrum, Vec3 direction) {
  std::vector<double> basis(sh_count(spectrum.max_degree));
  evaluate_sh_basis({direction.x, direction.z, direction.y}, spectrum.max_degree, basis);
  std::vector<double> result(spectrum.channels);
  for (int m = 0; m <= spectrum.max_degree; ++m) {
    for (int l = m; l <= spectrum.max_degree; ++l) {
      const std::complex<double>* a = &spectrum.values[spectrum.index(l, m) * spectrum.channels];
      const double even = basis[sh_index(l, m)], odd = m > 0 ? basis[sh_index(l, -m)] : 0;
      const double scale = m > 0 ? std::numbers::sqrt2 : 1;
      for (int c = 0; c < spectrum.channels; ++c)
        result[c] += scale * (a[c].real() * even - a[c].imag() * odd);
    }
  }
  return result;
}

std::vector<double> degree_power(const Spectrum& spectrum) {
  std::vector<double> power(spectrum.max_degree + 1);
  for (int c = 0; c < spectrum.channels; ++c) {
    std::vector<double> channel_power(power.size());
    for (int m = 0; m <= spectrum.max_degree; ++m)
      for (int l = m; l <= spectrum.max_degree; ++l)
        channel_power[l] +=
            (m > 0 ? 2 : 1) * std::norm(spectrum.values[spectrum.index(l, m) * spectrum.channels + c]);
    for (std::size_t l = 0; l < power.size(); ++l) power[l] = std::max(power[l], channel_power[l]);
  }
  return power;
}

Spectrum convolve(const Spectrum& spectrum, std::span<const double> factors) {
  const int degree = std::min(spectrum.max_degree, static_cast<int>(factors.size()) - 1);
  Spectrum result(degree, spectrum.channels);
  for (int m = 0; m <= degree; ++m)
    for (int l = m; l <= degree; ++l)
      for (int c = 0; c < spectrum.channels; ++c)
        result.values[result.index(l, m) * result.channels + c] =
            factors[l] * spectrum.values[spectrum.index(l, m) * spectrum.channels + c];
  return result;
}

}  // namespace welkin
