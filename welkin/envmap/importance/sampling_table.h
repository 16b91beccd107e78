#pragma once
#include <string>

#include <welkin/envmap/importance/environment_sampler.h>

// Tables that other programs sample environments with, and the shader code that does it.

namespace welkin {

enum class SamplingTableForm {
  rows,  ///< 1 x H, 1 channel: means of the rows' weights; the shader adds up rows, then the row's texels of the map
  cdf,  ///< (W + 2) x (H + 1), 1 channel: pixel (i, j) with i <= W, j < H is the CDF of row j before column i; the last
        ///< column is the CDF of the rows
  alias,  ///< W x H, 4 channels: what keeps the texel, column and row of the other one, probability of the texel
};

/// The table for a map as EnvironmentSampler needs it; options.table and interpolation are not read. Weights are luminance
/// times the row's solid angle (over that of a texel at the horizon) or luminance alone. Throws Error as
/// EnvironmentSampler does, and for a black map.
Image make_sampling_table(const Image& radiance, SamplingTableForm form,
                          const EnvironmentSamplerOptions& options = {});

/// GLSL ES 3.00: `WelkinSample welkin_sample(sampler2D environment, sampler2D table, vec2 u)` and
/// `float welkin_pdf(sampler2D environment, sampler2D table, vec3 direction)`, per steradian. Row 0 of both textures is the
/// first that is uploaded.
std::string sampling_table_glsl(SamplingTableForm form, const EnvironmentSamplerOptions& options = {});

}  // namespace welkin
