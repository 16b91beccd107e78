#include <welkin/realtime/gpu_environment.h>

#include <atomic>
#include <cmath>

namespace welkin {
namespace {

GlTexture upload_dfg(const DfgTable& table) {
  Image image(table.size, table.size, 2);
  image.pixels = table.scale_bias;
  TextureDesc desc;
  desc.format = TexelFormat::rg16f;
  return upload_image(image, desc, false);
}

}  // namespace

GpuEnvironment upload_environment(const IblSet& set, TexelFormat format, LevelLaw law) {
  static std::atomic<std::uint64_t> uploads{0};
  GpuEnvironment gpu;
  gpu.upload = ++uploads;
  gpu.environment = upload_cube(set.environment, format);
  gpu.specular = upload_cube(set.specular, format);
  gpu.irradiance = upload_cube({{set.irradiance}}, format);
  gpu.dfg = upload_dfg(set.dfg);
  gpu.environment_size = set.environment.size();
  gpu.environment_levels = static_cast<int>(set.environment.levels.size());
  gpu.specular_size = set.specular.size();
  gpu.specular_levels = static_cast<int>(set.specular.levels.size());
  gpu.law = law;
  gpu.irradiance_size = set.irradiance.size;
  for (std::size_t i = 0; i < 9; ++i) {
    const double* rgb = &set.radiance_sh.values[3 * i];
    gpu.radiance_sh[i] = {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
  }
  return gpu;
}

Affine world_to_environment(float rotation_radians) {
  // The environment is turned by +angle, so directions are turned by -angle.
  const float c = std::cos(rotation_radians), s = std::sin(rotation_radians);
  return {{c, 0, s}, {0, 1, 0}, {-s, 0, c}, {}};
}

void set_environment(const Program& program, const GpuEnvironment& environment) {
  program.set_texture("environment_map", 5, GL_TEXTURE_CUBE_MAP, environment.environment);
  program.set_texture("specular_map", 6, GL_TEXTURE_CUBE_MAP, environment.specular);
  program.set_texture("irradiance_map", 7, GL_TEXTURE_CUBE_MAP, environment.irradiance);
  program.set_texture("dfg_map", 8, GL_TEXTURE_2D, environment.dfg);
  program.set("specular_last_level", static_cast<float>(environment.specular_levels - 1));
  program.set("environment_last_level", static_cast<float>(environment.environment_levels - 1));
  program.set("specular_law", static_cast<int>(environment.law));
  program.set("specular_size", static_cast<float>(environment.specular_size));
  program.set_linear("world_to_environment", world_to_environment(environment.rotation_radians));
  program.set_vec3_array("radiance_sh", {environment.radiance_sh.begin(), environment.radiance_sh.end()});
}

}  // namespace welkin
