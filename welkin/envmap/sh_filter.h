#pragma once
#include <welkin/envmap/zonal_kernel.h>
#include <welkin/sh/projection.h>

namespace welkin {

/// The function filtered by a kernel: degree l times legendre_coefficients(kernel)[l]. Exact for what the coefficients
/// hold. make_lambert_kernel() makes radiance into irradiance / pi. Throws Error when the coefficients are malformed.
ShCoefficients convolve(const ShCoefficients& coefficients, const ZonalKernel& kernel);

}  // namespace welkin
