#pragma once
#include <span>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sh/basis.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// Coefficients of a function on the sphere in the real basis of basis.h (world frame, polar axis z). What the
/// function is (radiance, irradiance, ...) is said by whoever holds it.
struct ShCoefficients {
  int max_degree = -1;
  int channels = 3;
  /// channels interleaved: the channel c of degree l, order m is values[sh_index(l, m) * channels + c].
  std::vector<double> values;

  ShCoefficients() = default;
  /// All zero.
  ShCoefficients(int degree, int channel_count)
      : max_degree(degree), channels(channel_count), values(sh_count(degree) * channel_count) {}
};

/// The largest degree of project_equirect: its change of polar axis costs degree^4.
inline constexpr int max_projection_degree = 128;

/// Projects an equirectangular radiance map: coefficient = integral of L Y_lm over the sphere (not convolved, nothing
/// divided out), each texel a patch of constant radiance integrated exactly to rounding (error < 1e-9 of the largest
/// coefficient). Throws Error when max_degree is negative or above max_projection_degree.
ShCoefficients project_equirect(const Image& radiance, int max_degree);

/// The same by one centre sample a texel times its exact solid angle, as the literature does (King 2005, equation
/// 10-3): simple, and off by the curvature of Y_lm within a texel, O((degree pi / height)^2).
ShCoefficients project_equirect_texel_centres(const Image& radiance, int max_degree);

/// The value in a unit direction: sum of coefficient * Y_lm, one per channel, to out (size = channels).
void evaluate(const ShCoefficients& coefficients, Vec3 direction, std::span<double> out);

}  // namespace welkin
