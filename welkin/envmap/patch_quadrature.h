#pragma once
#include <welkin/envmap/zonal_kernel.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// A rectangle in (theta, phi) on the sphere: one texel of an equirectangular map.
struct SpherePatch {
  double theta0 = 0, theta1 = 0, phi0 = 0, phi1 = 0;
};

/// The patch of texel (x, y) of a width x height map.
SpherePatch equirect_patch(int width, int height, int x, int y);

/// How many Gauss-Legendre nodes a side integrate a function over an interval of half width h to a relative error of
/// about 1e-7, when its nearest complex singularity lies at distance s: the error falls as rho^(-2n) with
/// rho = s/h + sqrt((s/h)^2 + 1), the Bernstein ellipse through that singularity (Trefethen 2008, theorem 4.5); the
/// rate is asked to reach 1e-8, which pays for the constant before it. At least 2.
int patch_nodes(double singularity_distance, double half_width);

/// The distances, in half widths, beyond which one node (relative error 1e-5, for what is far from the axis) and two
/// nodes a side (1e-7) do.
inline constexpr double one_node_distance = 500, two_node_distance = 50;

/// Kernels whose kink at 90 degrees is steeper than this (see kink_slope) are integrated piecewise across it.
inline constexpr double steep_kink = 1e-3;

/// Integral of K(angle to direction) over the patch, to a relative error of about 1e-7, however narrow K is (1e-5 where the patch
/// lies across the kink at 90 degrees). With
/// near_angle > 0, of the kernel's core alone (see core_share in zonal_kernel.h).
double integrate_kernel(const ZonalKernel& kernel, Vec3 direction, const SpherePatch& patch,
                        double near_angle = 0);

}  // namespace welkin
