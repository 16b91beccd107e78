#include <welkin/realtime/techniques/sampled_environment.h>

#include <algorithm>
#include <cstddef>

#include <welkin/brdf/scatter/energy_table.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

GlTexture upload_exact(const Image& image, TexelFormat format) {
  TextureDesc desc;
  desc.format = format;
  desc.linear = false;
  return upload_image(image, desc, false);
}

Image no_wider_than(const Image& radiance, int largest) {
  if (radiance.width <= largest) return radiance;
  const int height = std::max(1, static_cast<int>(std::int64_t{radiance.height} * largest / radiance.width));
  ResampleOptions options;
  options.interpolate = false;
  return resample({Mapping::equirectangular, radiance}, {Mapping::equirectangular, largest, height}, options)
      .image;
}

}  // namespace

SampledEnvironment upload_sampled_environment(const Image& radiance,
                                              const SampledEnvironmentOptions& options) {
  EnvironmentSamplerOptions sampler;
  sampler.density = options.density;
  check_sampled_map(radiance, sampler);
  const Image map = no_wider_than(radiance, options.largest_width);
  SampledEnvironment uploaded;
  uploaded.map = upload_exact(map, TexelFormat::rgba32f);
  uploaded.black = std::all_of(map.pixels.begin(), map.pixels.end(), [](float v) { return !(v > 0); });
  if (uploaded.black) return uploaded;
  const bool wide = options.form == SamplingTableForm::alias;
  uploaded.table = upload_exact(make_sampling_table(map, options.form, sampler),
                                wide ? TexelFormat::rgba32f : TexelFormat::r32f);
  return uploaded;
}

std::string sampled_environment_glsl(SamplingTableForm form, EnvironmentDensity density) {
  EnvironmentSamplerOptions options;
  options.density = density;
  return "#define WELKIN_TABLE\n" + sampling_table_glsl(form, options);
}

ScatterEnergies upload_scatter_energies() {
  const EnergyTable& table = ggx_energy_table();
  Image energies(EnergyTable::columns, table.rows, 2);
  for (std::size_t i = 0; i < table.energies.size(); ++i) {
    energies.pixels[2 * i] = table.energies[i].lost;
    energies.pixels[2 * i + 1] = table.energies[i].bias;
  }
  Image averages(static_cast<int>(table.averages.size()), 1, 4);
  for (std::size_t i = 0; i < table.averages.size(); ++i) {
    const EnergyAverage& a = table.averages[i];
    std::copy_n(std::initializer_list<float>{a.lost, a.bias, a.spread, a.log_spread}.begin(), 4,
                &averages.pixels[4 * i]);
  }
  TextureDesc desc;
  desc.format = TexelFormat::rg16f;
  return {upload_image(energies, desc, false), upload_exact(averages, TexelFormat::rgba32f)};
}

}  // namespace welkin
