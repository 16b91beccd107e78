#pragma once
#include <welkin/envmap/zonal_kernel.h>
#include <welkin/image/image.h>

// The cube that a method filters instead of the equirectangular map: private to welkin/envmap/methods.

namespace welkin {

/// The map on a cube of `size`: each texel the exact mean of the map over its patch, however fine it is, so that the
/// cube holds what the box model of the map says, and all of its energy.
Cube working_cube(const Image& radiance, int size);

/// The least size a cube needs for its texels (at the middles of faces) to be no wider than 1/texels_a_width of the
/// angle over which the kernel varies, and no finer than the map deserves (matching_cube_size).
int working_cube_size(const Image& radiance, const ZonalKernel& kernel, double texels_a_width);

/// The spread of a kernel: the standard deviation along one axis of the Gaussian that has as much energy near its
/// axis: the angle (rad) within which 1 - exp(-1/2) of the energy lies. 1/sqrt(N) for a sharp Phong lobe; finite
/// where the second moment is not (ggx).
double kernel_spread(const ZonalKernel& kernel);

}  // namespace welkin
