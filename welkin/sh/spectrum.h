#pragma once
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include <welkin/sphere/vec3.h>

namespace welkin {

/// The spherical-harmonic spectrum of a real function on the sphere to a high degree, in the frame of an
/// equirectangular map: polar axis +Y, azimuth phi as in welkin/sphere/equirect.h. Complex coefficients a_lm, m >= 0,
/// of the orthonormal functions P_lm(cos theta) exp(i m phi) without Condon-Shortley sign:
///   f = sum_l [ a_l0 P_l0 + 2 Re sum_(m>0) a_lm P_lm exp(i m phi) ].
/// It is what the fast transform makes and takes; for the coefficients that people exchange see projection.h.
struct Spectrum {
  int max_degree = -1;
  int channels = 3;
  /// channels interleaved, a_l0 real; the channel c of a_lm is values[index(l, m) * channels + c].
  std::vector<std::complex<double>> values;

  Spectrum() = default;
  /// All zero.
  Spectrum(int degree, int channel_count);

  /// Orders m follow each other, each with its degrees l = m .. max_degree.
  std::size_t index(int l, int m) const {
    return static_cast<std::size_t>(m) * static_cast<std::size_t>(2 * max_degree + 3 - m) / 2 +
           static_cast<std::size_t>(l - m);
  }
};

/// The function's value in a direction, one double per channel: the slow, obvious sum, O(max_degree^2), for checks and
/// for small degrees (max_degree <= max_basis_degree).
std::vector<double> evaluate(const Spectrum& spectrum, Vec3 direction);

/// sum over m of |a_lm|^2, all orders of both signs counted, for every degree l, of the channel where it is largest.
std::vector<double> degree_power(const Spectrum& spectrum);

/// Multiplies a_lm by factors[l] (Funk-Hecke: convolution with a zonal kernel) and drops degrees >= factors.size().
Spectrum convolve(const Spectrum& spectrum, std::span<const double> factors);

}  // namespace welkin
