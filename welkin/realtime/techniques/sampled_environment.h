#pragma once
#include <cstdint>
#include <string>

#include <welkin/envmap/importance/sampling_table.h>
#include <welkin/realtime/gl/texture.h>

// What a shader samples an equirectangular environment with: the map and a table of it as textures, and the text that reads them.

namespace welkin {

struct SampledEnvironmentOptions {
  SamplingTableForm form = SamplingTableForm::cdf;
  EnvironmentDensity density = EnvironmentDensity::luminance_solid_angle;
  int largest_width = 2048;  ///< wider maps are averaged down to it (by solid angle)
};

/// The map as RGBA32F and the table as R32F or RGBA32F, nearest, row 0 the top.
struct SampledEnvironment {
  GlTexture map, table;
  bool black = false;  ///< no table could be made: `table` is empty
};

/// radiance: equirectangular, 3 channels, finite and >= 0. Throws Error for others.
SampledEnvironment upload_sampled_environment(const Image& radiance,
                                              const SampledEnvironmentOptions& options);

/// sampling_table_glsl and #define WELKIN_TABLE: what stands before a fragment shader that calls welkin_sample.
std::string sampled_environment_glsl(SamplingTableForm form, EnvironmentDensity density);

/// The energies that scatter_layers.glsl reads: energy_map as RG16F, linear; energy_average_map as RGBA32F, nearest.
struct ScatterEnergies {
  GlTexture energies, averages;
};
ScatterEnergies upload_scatter_energies();

}  // namespace welkin
