#pragma once
#include <span>
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sphere/vec3.h>

// Zonal functions: functions of the angle to an axis alone. About z they have one coefficient a degree,
//   f(cos theta) = sum over l of z_l Y_l0,   Y_l0 = sqrt((2l+1)/(4 pi)) P_l(cos theta),
// which is what "zonal" is in every signature here. Convolution with f multiplies degree l by
// k_l = sqrt(4 pi/(2l+1)) z_l (Funk-Hecke); project_zonal and ZonalKernel speak of the k_l.

namespace welkin {

/// k_l from z_l, and z_l from k_l.
std::vector<double> convolution_factors(std::span<const double> zonal);
std::vector<double> zonal_coefficients(std::span<const double> factors);

/// The function about another axis (unit length): c_lm = sqrt(4 pi/(2l+1)) z_l Y_lm(axis) (Sloan 2008, "Stupid SH
/// Tricks"; Snyder 1996). One channel, degree zonal.size() - 1; zonal is not empty, else Error.
ShCoefficients turn_zonal(std::span<const double> zonal, Vec3 axis);

/// The value at an angle to the axis, |cos_theta| <= 1, by the recurrence of P_l.
double evaluate_zonal(std::span<const double> zonal, double cos_theta);

/// Zonal coefficients for l = 0 .. max_degree of
///   a point light whose integral is 1 (cut at max_degree, it rings);
///   the cap that is 1 within `radius` (rad, in [0, pi]) of the axis and 0 outside, accurate also for a sun;
///   max(0, cos theta).
/// Throw Error when max_degree is not in [0, max_basis_degree] or radius is out of range.
std::vector<double> zonal_delta(int max_degree);
std::vector<double> zonal_cap(double radius, int max_degree);
std::vector<double> zonal_clamped_cosine(int max_degree);

}  // namespace welkin
