#pragma once
#include <cmath>
#include <numbers>

#include <welkin/sphere/vec3.h>

// Equirectangular (latitude-longitude) maps. With u in [0,1) rightwards and v in [0,1] downwards from +Y:
//   theta = pi v, phi = 2 pi (u - 1/2), direction = (sin theta cos phi, cos theta, sin theta sin phi).
// The middle column looks along +X. Texel (i, j) of a W x H map covers [i, i+1) x [j, j+1) in (u W, v H).

namespace welkin {

struct Uv {
  double u = 0, v = 0;
};

/// The unit direction of (u, v).
inline Vec3 equirect_direction(Uv uv) {
  const double theta = std::numbers::pi * uv.v;
  const double phi = 2 * std::numbers::pi * (uv.u - 0.5);
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// The (u, v) of a direction of any length > 0: u in [0, 1), v in [0, 1].
inline Uv equirect_uv(Vec3 direction) {
  const double u = std::atan2(direction.z, direction.x) / (2 * std::numbers::pi) + 0.5;
  const double v = std::atan2(std::hypot(direction.x, direction.z), direction.y) / std::numbers::pi;
  return {u >= 1 ? u - 1 : u, v};
}

/// The exact solid angle (sr) of any texel of `row` in a width x height map: 2 pi / W (cos theta_j - cos theta_j+1),
/// written as a product so that nothing cancels near the poles. All texels together give 4 pi.
inline double equirect_texel_solid_angle(int width, int height, int row) {
  const double half_step = std::numbers::pi / (2.0 * height);
  const double centre = (2 * row + 1) * half_step;
  return 4 * std::numbers::pi / width * std::sin(centre) * std::sin(half_step);
}

/// The integral of the direction over a texel's patch, exact: the sum over all texels that are lit, times radiance, is
/// the vector irradiance. Its length over the solid angle is below 1 by half the patch's angular variance.
///   integral of sin^2 theta d theta = (step - cos 2 theta_c sin step) / 2, of sin theta cos theta = sin 2 theta_c sin step / 2,
///   of cos phi d phi = 2 sin(step / 2) cos phi_c, about the centre (theta_c, phi_c).
inline Vec3 equirect_texel_moment(int width, int height, int x, int row) {
  const double step = std::numbers::pi / height, theta = (row + 0.5) * step;
  const double phi_step = 2 * std::numbers::pi / width, phi = (x + 0.5) * phi_step - std::numbers::pi;
  const double across = (step - std::cos(2 * theta) * std::sin(step)) * std::sin(phi_step / 2);
  return {across * std::cos(phi), 0.5 * std::sin(2 * theta) * std::sin(step) * phi_step,
          across * std::sin(phi)};
}

}  // namespace welkin
