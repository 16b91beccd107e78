#include <welkin/envmap/importance/sampling_table.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <welkin/error.h>

#include "importance_cases.h"

#include <unistd.h>

namespace welkin {
namespace {

const SamplingTableForm forms[] = {SamplingTableForm::rows, SamplingTableForm::cdf, SamplingTableForm::alias};

std::vector<EnvironmentSamplerOptions> both_densities() {
  EnvironmentSamplerOptions flat;
  flat.density = EnvironmentDensity::luminance;
  return {{}, flat};
}

// What the shader computes for a texel's probability.
double probability(const Image& map, const Image& table, SamplingTableForm form,
                   const EnvironmentSamplerOptions& options, int x, int y) {
  if (form == SamplingTableForm::alias) return table.at(x, y)[3];
  if (form == SamplingTableForm::cdf) {
    const int last = map.width + 1;
    return double{table.at(x + 1, y)[0] - table.at(x, y)[0]} *
           (table.at(last, y + 1)[0] - table.at(last, y)[0]);
  }
  double total = 0;
  for (float row : table.pixels) total += row;
  const float* p = map.at(x, y);
  const double factor = options.density == EnvironmentDensity::luminance
                            ? 1
                            : std::sin(std::numbers::pi * (y + 0.5) / map.height);
  return factor * luminance(Rgb{p[0], p[1], p[2]}) / (total * map.width);
}

TEST(SamplingTable, AgreesWithTheSampler) {
  const Image map = sun_map(32, 16, 1e3f);
  for (const EnvironmentSamplerOptions& options : both_densities()) {
    const EnvironmentSampler sampler(map, options);
    for (SamplingTableForm form : forms) {
      const Image table = make_sampling_table(map, form, options);
      double sum = 0;
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) {
          const double p = probability(map, table, form, options, x, y), t = (y + 0.5) / 16;
          const double jacobian = options.density == EnvironmentDensity::luminance
                                      ? 32 * 16 / (two_pi_squared * std::sin(std::numbers::pi * t))
                                      : 1 / equirect_texel_solid_angle(32, 16, y);
          const double pdf = sampler.pdf(float_direction((x + 0.5) / 32, t));
          EXPECT_NEAR(p * jacobian, pdf, 1e-4 * pdf + 0x1p-23 * jacobian)
              << x << " " << y;  // two steps of the CDF
          sum += p;
        }
      EXPECT_NEAR(sum, 1, 1e-5);
    }
  }
}

// The alias table that is written: every place keeps its share and gives the rest away.
TEST(SamplingTable, AliasPixelsAddUpToTheirProbabilities) {
  const Image map = holey_map(12, 6, 3), table = make_sampling_table(map, SamplingTableForm::alias);
  std::vector<double> given(72);
  for (int k = 0; k < 72; ++k) {
    const float* p = table.at(k % 12, k / 12);
    given[k] += p[0] / 72.0;
    given[static_cast<std::size_t>(p[2]) * 12 + static_cast<std::size_t>(p[1])] += (1 - p[0]) / 72.0;
  }
  for (int k = 0; k < 72; ++k) EXPECT_NEAR(given[k], table.at(k % 12, k / 12)[3], 1e-7) << k;
}

TEST(SamplingTable, RefusesABlackMap) {
  for (SamplingTableForm form : forms) EXPECT_THROW(make_sampling_table(Image(4, 2), form), Error);
}

TEST(SamplingTable, ShadersCompile) {
  if (std::string(WELKIN_GLSLANG).empty())
    GTEST_SKIP() << "glslangValidator (Debian glslang-tools) is not there";
  const auto file =
      std::filesystem::temp_directory_path() / ("welkin-sampling-" + std::to_string(::getpid()) + ".frag");
  for (const EnvironmentSamplerOptions& options : both_densities())
    for (SamplingTableForm form : forms) {
      std::ofstream(file)
          << "#version 300 es\nprecision highp float;\nprecision highp int;\n"
             "uniform highp sampler2D environment, table;\nout vec4 colour;\n"
          << sampling_table_glsl(form, options)
          << "void main() {\n  WelkinSample s = welkin_sample(environment, table, gl_FragCoord.xy);\n"
             "  colour = vec4(s.direction, s.pdf + welkin_pdf(environment, table, s.direction));\n}\n";
      const std::string command = std::string(WELKIN_GLSLANG) + " '" + file.string() + "' > /dev/null";
      EXPECT_EQ(std::system(command.c_str()), 0);
    }
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace welkin
