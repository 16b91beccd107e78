#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <welkin/image/z_test.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/gl/shader_text.h>
#include <welkin/realtime/techniques/sampled_environment.h>

#include "tests/oracles/chi_square.h"
#include "tests/realtime/shading_truth.h"

// `importance` against sums over the whole environment in double.

namespace welkin {
namespace {

constexpr int width = 14, height = 14, replicates = 8;

// Dim and coloured, with a sun of four texels that has a third of the light.
Image sun_map() {
  Image map(32, 16);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      float* p = map.at(x, y);
      p[0] = 0.3f + 0.02f * static_cast<float>(y);
      p[1] = 0.4f;
      p[2] = 0.2f + 0.015f * static_cast<float>(x % 16);
    }
  for (int y = 4; y < 6; ++y)
    for (int x = 21; x < 23; ++x) std::fill_n(map.at(x, y), 3, 30.0f);
  return map;
}

struct NamedMaterial {
  const char* name;
  Material material;
};

std::vector<NamedMaterial> materials() {
  Material plastic, metal, mixed, single, coated, diffuse;
  plastic.metallic = 0;
  plastic.base_color = {0.7f, 0.3f, 0.2f};
  plastic.perceptual_roughness = 0.5f;
  metal.base_color = {0.9f, 0.7f, 0.4f};
  metal.perceptual_roughness = 0.6f;
  mixed = plastic;
  mixed.metallic = 0.5f;
  mixed.perceptual_roughness = 0.8f;
  single = metal;
  single.compensated = false;
  coated = plastic;
  coated.model = MaterialModel::coated_diffuse;
  diffuse = plastic;
  diffuse.model = MaterialModel::lambert;
  return {{"plastic", plastic},          {"metal", metal},   {"mixed", mixed},
          {"single scattering", single}, {"coated", coated}, {"diffuse", diffuse}};
}

// Pixels that see the sphere at more than 17 degrees from its silhouette.
struct TruthPicture {
  std::vector<std::size_t> pixels;
  Image radiance;  // as many x 1
};

TruthPicture truth_of(const Scene& scene, const Image& map) {
  const RenderScene traced(scene, nullptr);
  TruthPicture truth;
  std::vector<float> values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto point = oracle::point_at_pixel(traced, scene.cameras[0], {width, height}, x, y);
      if (!point || point->view.z < 0.3f) continue;
      truth.pixels.push_back(static_cast<std::size_t>(y) * width + x);
      for (const double v : oracle::reflected_by_sums(*point, map, 4))
        values.push_back(static_cast<float>(v));
    }
  truth.radiance = Image(static_cast<int>(truth.pixels.size()), 1);
  truth.radiance.pixels = values;
  return truth;
}

// The pixels of `truth` after `frames` frames.
Image converged(Renderer& renderer, const std::string& choice, int frames, const TruthPicture& truth) {
  const TechniqueChoice chosen = parse_technique(choice);
  renderer.set_technique(*chosen.technique, chosen.values);
  for (int i = 0; i < frames; ++i) renderer.draw();
  const Image picture = renderer.read_picture();
  Image picked(truth.radiance.width, 1);
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    std::copy_n(&picture.pixels[4 * truth.pixels[i]], 3, &picked.pixels[3 * i]);
  return picked;
}

struct Replicated {
  Image mean, standard_error;
};

Replicated replicated(Renderer& renderer, const std::string& choice, int frames, const TruthPicture& truth) {
  Replicated result{Image(truth.radiance.width, 1), Image(truth.radiance.width, 1)};
  std::vector<double> sum(result.mean.pixels.size()), squares(result.mean.pixels.size());
  for (int seed = 1; seed <= replicates; ++seed) {
    const Image picture = converged(renderer, choice + ",seed=" + std::to_string(seed), frames, truth);
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += picture.pixels[i];
      squares[i] += double{picture.pixels[i]} * picture.pixels[i];
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double mean = sum[i] / replicates;
    const double variance = (squares[i] - sum[i] * mean) / (replicates - 1);
    result.mean.pixels[i] = static_cast<float>(mean);
    result.standard_error.pixels[i] = static_cast<float>(std::sqrt(std::max(variance, 1e-14) / replicates));
  }
  return result;
}

void expect_equal(const Replicated& measured, const Image& truth, const std::string& what) {
  const ZTest z =
      z_test({&measured.mean, &measured.standard_error, replicates - 1.0}, {&truth, nullptr, {}}, 1e-3);
  EXPECT_TRUE(z.equal) << what << ": mean score " << z.mean_score << ", worst " << z.worst_score
                       << " of probability " << z.worst_probability << ", mean square " << z.mean_square;
}

constexpr RendererOptions exact{TexelFormat::rgba32f, TexelFormat::rgba16f};

void prepare(Renderer& renderer, const Scene& scene, const Image& map) {
  renderer.set_technique(find_technique("importance"), initial_values(find_technique("importance")));
  renderer.set_camera(scene.cameras[0]);
  renderer.set_scene(scene);
  renderer.set_environment(oracle::small_environment(map));
  renderer.resize(width, height);
}

// A program that writes welkin_sample of sample_pair, pixel after pixel, made here because no technique shows its directions.
GlProgram directions_program(SamplingTableForm form, EnvironmentDensity density) {
  const std::string head(shader_head());
  const std::string vertex = head + shader_text("fullscreen.vert");
  const std::string fragment =
      head + sampled_environment_glsl(form, density) + shader_text("sample_numbers.glsl") +
      "uniform sampler2D map, table;\nlayout(location = 0) out vec4 found;\nvoid main() {\n"
      "  uint i = uint(gl_FragCoord.x) + 256u * uint(gl_FragCoord.y);\n"
      "  WelkinSample s = welkin_sample(map, table, sample_pair(i % 64u, pixel_seed(ivec2(i / 64u, 5))));\n"
      "  found = vec4(s.direction, s.pdf);\n}\n";
  GlProgram program = GlProgram::make();
  for (const auto& [kind, text] :
       {std::pair(GL_VERTEX_SHADER, &vertex), std::pair(GL_FRAGMENT_SHADER, &fragment)}) {
    const GLuint shader = glCreateShader(kind);
    const char* source = text->c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program.name(), shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program.name());
  GLint linked = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  EXPECT_EQ(linked, GL_TRUE);
  return program;
}

// 65,536 directions, 64 of each of 1024 streams, with their densities.
Image drawn_directions(const Image& map, SamplingTableForm form, EnvironmentDensity density) {
  const GlProgram program = directions_program(form, density);
  const SampledEnvironment sampled = upload_sampled_environment(map, {form, density});
  const TexelFormat format = TexelFormat::rgba32f;
  const RenderTarget target = make_render_target(256, 256, &format, 1, false);
  target.bind();
  glDisable(GL_DEPTH_TEST);
  glUseProgram(program.name());
  bind_texture(0, GL_TEXTURE_2D, sampled.map);
  bind_texture(1, GL_TEXTURE_2D, sampled.table);
  glUniform1i(glGetUniformLocation(program.name(), "map"), 0);
  glUniform1i(glGetUniformLocation(program.name(), "table"), 1);
  Fullscreen().draw();
  return read_pixels(target);
}

// Samples of one stream keep their distance, so the statistic is below what independent ones give: this finds directions that do
// not follow the table, not numbers that are too even.
TEST(Importance, DirectionsFollowTheTableAndSayTheirDensity) {
  const HeadlessContext context;
  const Image map = sun_map();
  for (const auto form : {SamplingTableForm::cdf, SamplingTableForm::alias, SamplingTableForm::rows})
    for (const auto density : {EnvironmentDensity::luminance_solid_angle, EnvironmentDensity::luminance}) {
      EnvironmentSamplerOptions options;
      options.density = density;
      const EnvironmentSampler sampler(map, options);
      const Image drawn = drawn_directions(map, form, density);
      std::vector<double> observed(map.pixels.size() / 3), expected(observed.size());
      for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
          const double weight = luminance(Rgb{map.at(x, y)[0], map.at(x, y)[1], map.at(x, y)[2]});
          expected[static_cast<std::size_t>(y * map.width + x)] =
              weight * (density == EnvironmentDensity::luminance
                            ? 1
                            : equirect_texel_solid_angle(map.width, map.height, y));
        }
      const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
      for (double& e : expected) e *= 65536 / total;
      int wrong_density = 0;
      for (int i = 0; i < 65536; ++i) {
        const float* d = &drawn.pixels[static_cast<std::size_t>(4 * i)];
        const auto texel = sampler.texel_of({d[0], d[1], d[2]});
        ++observed[static_cast<std::size_t>(texel.y * map.width + texel.x)];
        // A direction within rounding of a texel's edge may be counted to its neighbour.
        wrong_density += std::abs(d[3] / sampler.pdf({d[0], d[1], d[2]}) - 1) > 1e-3f;
      }
      const oracle::ChiSquare chi = oracle::chi_square(observed, expected);
      const int which = 2 * static_cast<int>(form) + static_cast<int>(density);
      EXPECT_GT(chi.p, oracle::sidak_threshold(1e-3, 6)) << which << ": " << chi.statistic;
      EXPECT_LT(wrong_density, 20) << which;
    }
}

TEST(Importance, EveryStrategyAndTableGivesTheSumOverTheEnvironment) {
  const HeadlessContext context;
  {
    const Image map = sun_map();
    const Scene scene = oracle::one_sphere(materials()[2].material);
    const TruthPicture truth = truth_of(scene, map);
    ASSERT_GT(truth.pixels.size(), 80u);
    Renderer renderer(exact);
    prepare(renderer, scene, map);
    // Few of these samples meet the sun, and scores are normal only where some do.
    expect_equal(replicated(renderer, "importance:sampling=brdf,samples=64", 8, truth), truth.radiance,
                 "brdf");
    for (const char* table : {"inverse", "alias", "rows"})
      for (const char* jacobian : {"sphere", "lecture"})
        for (const char* sampling : {"environment", "mis"}) {
          const std::string choice = std::string("importance:sampling=") + sampling + ",table=" + table +
                                     ",jacobian=" + jacobian + ",samples=64";
          expect_equal(replicated(renderer, choice, 1, truth), truth.radiance, choice);
        }
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

TEST(Importance, EveryMaterialGivesTheSumOverTheEnvironment) {
  const HeadlessContext context;
  const Image map = sun_map();
  Renderer renderer(exact);
  for (const NamedMaterial& entry : materials()) {
    const Scene scene = oracle::one_sphere(entry.material);
    const TruthPicture truth = truth_of(scene, map);
    prepare(renderer, scene, map);
    expect_equal(replicated(renderer, "importance:samples=64", 2, truth), truth.radiance, entry.name);
  }
}

// Where everything is 1, white reflects 1: facets, the light between them and the base under a coat, at every roughness.
TEST(Importance, UnderAWhiteSkyWhiteReflectsEverything) {
  const HeadlessContext context;
  Image white(16, 8);
  std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
  Renderer renderer(exact);
  for (const float metallic : {0.0f, 0.5f, 1.0f})
    for (const float roughness : {0.1f, 0.4f, 1.0f}) {
      Material material;
      material.metallic = metallic;
      material.perceptual_roughness = roughness;
      const Scene scene = oracle::one_sphere(material);
      prepare(renderer, scene, white);
      const TechniqueChoice chosen = parse_technique("importance:samples=64");
      renderer.set_technique(*chosen.technique, chosen.values);
      for (int i = 0; i < 4; ++i) renderer.draw();
      const Image picture = renderer.read_picture();
      double sum = 0;
      for (int y = 6; y < 8; ++y)
        for (int x = 3; x < 11; ++x) sum += picture.at(x, y)[1] / 16;
      // 4096 samples, each of a standard deviation below 0.3 where BRDF and environment are combined.
      EXPECT_NEAR(sum, 1, 0.01) << "metallic " << metallic << ", roughness " << roughness;
    }
}

// More frames make the picture better, and any change starts it anew.
TEST(Importance, FramesAddUpUntilSomethingChanges) {
  const HeadlessContext context;
  const Image map = sun_map();
  const Scene scene = oracle::one_sphere(materials()[0].material);
  const TruthPicture truth = truth_of(scene, map);
  Renderer renderer(exact);
  prepare(renderer, scene, map);
  const auto error = [&](int frames) {
    const Image picture = converged(renderer, "importance:samples=1", frames, truth);
    double squares = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      squares += std::pow(picture.pixels[i] - truth.radiance.pixels[i], 2);
    return std::sqrt(squares);
  };
  const double one = error(1), many = error(64);
  EXPECT_LT(many, one / 6);  // independent samples would give an eighth, give or take; these are stratified
  EXPECT_EQ(renderer.accumulated(), 64);
  EXPECT_EQ(error(1), one);  // the choice was set again
}

}  // namespace
}  // namespace welkin
