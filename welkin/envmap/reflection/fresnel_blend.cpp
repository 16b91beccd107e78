#include <welkin/envmap/reflection/fresnel_blend.h>

#include <fmt/format.h>

#include <algorithm>

#include <welkin/error.h>
#include <welkin/sphere/cube_lookup.h>

namespace welkin {

FresnelBlend prepare_fresnel_blend(const Image& radiance, const FresnelBlendMaterial& material,
                                   const FresnelBlendOptions& options) {
  check_fresnel_blend(material);
  for (int size : {options.irradiance_size, options.glossy_size})
    if (size < 1 || size > 8192) throw Error(fmt::format("the size must lie in [1, 8192], not {}", size));
  const std::array targets = {FilterTarget{make_lambert_kernel(), options.irradiance_size},
                              FilterTarget{make_phong_kernel(material.exponent), options.glossy_size}};
  std::vector<Cube> maps = filter_environment(radiance, targets, options.filter);
  return {material, std::move(maps[0]), std::move(maps[1])};
}

std::array<double, 3> reflect(const FresnelBlend& surface, const ReflectionQuery& query) {
  const double cos_view = std::min(1.0, dot(query.normal, query.view));
  if (cos_view <= 0) return {};
  float diffuse[4], glossy[4];
  look_up_cube(surface.irradiance_over_pi, query.normal, diffuse);
  look_up_cube(surface.glossy, 2 * cos_view * query.normal - query.view, glossy);
  const std::array<double, 3> f = reflectance(surface.material.fresnel, cos_view);
  std::array<double, 3> rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[c] = (1 - f[c]) * surface.material.albedo[c] * static_cast<double>(diffuse[c]) +
             f[c] * static_cast<double>(glossy[c]);
  return rgb;
}

}  // namespace welkin
