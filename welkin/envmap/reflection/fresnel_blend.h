#pragma once
#include <array>

#include <welkin/brdf/fresnel_blend.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>

namespace welkin {

struct FresnelBlendOptions {
  int irradiance_size = 64, glossy_size = 256;  ///< texels along an edge, 1 to 8192
  FilterOptions filter;
};

/// The maps that the material looks up: F is taken out of both integrals, at the angle of view.
struct FresnelBlend {
  FresnelBlendMaterial material;
  Cube irradiance_over_pi, glossy;
};

/// radiance: equirectangular, 3 channels. Throws Error for parameters out of range.
FresnelBlend prepare_fresnel_blend(const Image& radiance, const FresnelBlendMaterial& material,
                                   const FresnelBlendOptions& options = {});

/// (1 - F(n.v)) albedo irradiance(n) / pi + F(n.v) glossy(r); 0 where the view lies below the surface.
std::array<double, 3> reflect(const FresnelBlend& surface, const ReflectionQuery& query);

}  // namespace welkin
