#pragma once
#include <span>
#include <vector>

#include <welkin/envmap/zonal_kernel.h>
#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// The oracle of every filter: the sum over every texel of an equirectangular map (Greene 1986), in double, each texel
/// a patch of constant radiance over which the kernel is integrated as integrate_kernel does (patch_quadrature.h), or with as many nodes as that
/// asks for.
/// Returns filtered radiance [(direction * kernels.size() + kernel) * 3 + channel]; for kernel lambert that is
/// irradiance / pi. radiance has 3 channels; directions are unit length. Costs directions * texels * kernels.
std::vector<double> filter_brute_force(const Image& radiance, std::span<const Vec3> directions,
                                       std::span<const ZonalKernel> kernels);

}  // namespace welkin
