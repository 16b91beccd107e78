#pragma once
#include <span>
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sphere/vec3.h>

// ZH3 (Roughton, Sloan, Silvennoinen, Iwanicki & Shirley 2024, "ZH3: Quadratic Zonal Harmonics"): irradiance of degree
// 1 in each channel, and of degree 2 only what is symmetric about one axis that all channels share:
//   E(n) = sum of degrees 0 and 1 + zonal * sqrt(5/(16 pi)) (3 (axis.n)^2 - 1).
// 15 numbers for RGB (the axis needs none of its own where it is the luminance axis of the linear part) against 27.

namespace welkin {

struct Zh3 {
  /// Degree 1, irradiance (the cosine is in it), channels interleaved as in ShCoefficients.
  ShCoefficients linear{1, 3};
  Vec3 axis{0, 0, 1};  // unit length
  /// One a channel: the coefficient of the orthonormal Y_20 turned to the axis; irradiance too.
  std::vector<double> zonal = {0, 0, 0};
};

/// The published axis: the direction of the linear part of luminance, 0.2126 R + 0.7152 G + 0.0722 B (all channels
/// alike where there are not three); +z where that part is zero. Needs degree 1 or more.
Vec3 zh3_luminance_axis(const ShCoefficients& irradiance);

/// The axis for which the nearest ZH3 in L2, all channels counted alike, is nearest of all: the maximum over the sphere
/// of a polynomial of degree four, found by ascent from several starts (a local maximum where all of them miss). Needs
/// degree 2.
Vec3 zh3_best_axis(const ShCoefficients& irradiance);

/// The nearest ZH3 with this axis in L2 over the sphere: degrees 0 and 1 as they are, and
///   zonal = sqrt(4 pi/5) sum over m of E_2m Y_2m(axis),
/// the projection of degree 2 onto the turned Y_20. Throws Error unless the degree is 2 and every number finite.
Zh3 fit_zh3(const ShCoefficients& irradiance, Vec3 axis);

/// ZH3 from degree 1 alone, as published (section 3.4.3): luminance axis, and for each channel, in radiance, with r =
/// |L_1 . axis| / L_00,  zonal = L_00 (0.08 r + 0.6 r^2). Zero where L_00 <= 0.
Zh3 hallucinate_zh3(const ShCoefficients& irradiance);

/// The nearest ZH3 with the same axis whose channels are nowhere negative, each one proven so as in nonnegative.h
/// (proves_nonnegative finds its nine coefficients zh3_to_sh). A channel that is proven already stays as it is.
Zh3 nonnegative_zh3(const Zh3& zh3);

/// The nine coefficients a channel of the same function.
ShCoefficients zh3_to_sh(const Zh3& zh3);

/// E(n), one value per channel; n is unit length.
void evaluate(const Zh3& zh3, Vec3 normal, std::span<double> out);

}  // namespace welkin
