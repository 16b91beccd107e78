#pragma once
#include <span>
#include <vector>

#include <welkin/sh/projection.h>

namespace welkin {

/// Values of small coefficient sets on rings about the z axis, and back: private to welkin/sh. On a ring at height z
///   f(phi) = sum over m of A_m cos m phi + B_m sin m phi,   A_m = sum over l of p_lm c_lm, B_m with c_l-m,
/// where p_lm = Y_lm(z, phi = 0). So a ring costs one Legendre recurrence, not one a point.
class RingTransform {
 public:
  /// `azimuths` points a ring at phi = 2 pi k / azimuths, degrees up to max_degree.
  RingTransform(int max_degree, int azimuths);

  /// Moves to the ring at height z, |z| <= 1.
  void set_ring(double z);

  /// values[k * channels + c] = f at the ring's point k.
  void synthesize(const ShCoefficients& coefficients, std::vector<double>& values);

  /// Adds weight * (sum over k of values_k Y_lm(point k)) to every coefficient.
  void add_analysis(std::span<const double> values, double weight, ShCoefficients& coefficients);

  /// cos phi and sin phi of point k.
  double cosine(int k) const { return cosines_[k]; }
  double sine(int k) const { return sines_[k]; }

 private:
  int max_degree_, azimuths_;
  std::vector<double> cosines_, sines_;  // of 2 pi k / azimuths
  std::vector<double> legendre_;         // p_lm at sh_index(l, m), m >= 0
  std::vector<double> orders_;           // A_m and B_m of one ring
};

}  // namespace welkin
