#include <gtest/gtest.h>

#include <cmath>

#include "dynamic_test_scene.h"

#include <welkin/realtime/capture/glossy_maps.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

constexpr int capture_size = 32, probe_size = 8;
constexpr std::size_t probe_step = 4;  // directions that are compared: one of so many

// What glossy.glsl gives for a roughness in the directions of a small cube's texels.
Cube probe(const GlossyMaps& maps, const GlTexture& cube, float roughness, int size) {
  TextureDesc desc;
  desc.width = size;
  desc.format = TexelFormat::rgba32f;
  desc.linear = false;
  const GlTexture target = make_cube_texture(desc);
  const GlFramebuffer framebuffer = GlFramebuffer::make();
  const Program program("fullscreen.vert", "glossy_probe.frag");
  const Fullscreen fullscreen;
  program.use();
  maps.set(program, cube);
  program.set("size", static_cast<float>(size));
  program.set("perceptual_roughness", roughness);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, size, size);
  for (int face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), target.name(), 0);
    program.set("face", face);
    fullscreen.draw();
  }
  return read_cube(target, size, 0);
}

double relative_rms(const Cube& values, const std::vector<std::array<double, 3>>& truth) {
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      error += std::pow(static_cast<double>(values.texels[3 * probe_step * i + c]) - truth[i][c], 2);
      sum += truth[i][c] * truth[i][c];
    }
  return std::sqrt(error / sum);
}

std::vector<std::array<double, 3>> brute_force(const Cube& cube, double roughness) {
  const ZonalKernel kernel = make_ggx_kernel(roughness * roughness);
  std::vector<std::array<double, 3>> truth;
  for (int i = 0; i < 6 * probe_size * probe_size; i += static_cast<int>(probe_step))
    truth.push_back(sum_over_cube(
        cube, cube_texel_direction(probe_size, i / 64, i % probe_size, i / probe_size % probe_size), kernel));
  return truth;
}

struct GlossyCase {
  GlossyMethod method;
  int taps;
  double at_half, at_one;  ///< limits of the relative RMS at roughness 0.5 and 1
};

class DynamicGlossy : public testing::TestWithParam<GlossyCase> {};

TEST_P(DynamicGlossy, MapsAreNearTheLobeSummedOverTheCapture) {
  const HeadlessContext context;
  {
    const CapturedRoom room(SurroundingsKind::none, CaptureInput::cube, capture_size, 1, 0);
    const Cube radiance = room.capture.read_as_cube();
    const Fullscreen fullscreen;
    GlossyMaps maps({GetParam().method, false, GetParam().taps, capture_size});
    maps.update(room.capture.cube(), fullscreen);
    const double half =
        relative_rms(probe(maps, room.capture.cube(), 0.5f, probe_size), brute_force(radiance, 0.5));
    const double one =
        relative_rms(probe(maps, room.capture.cube(), 1, probe_size), brute_force(radiance, 1));
    EXPECT_LT(half, GetParam().at_half);
    EXPECT_LT(one, GetParam().at_one);
    EXPECT_GT(half, 0.05 * GetParam().at_half);
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

// Three lamps and noise; measured and a third more.
INSTANTIATE_TEST_SUITE_P(All, DynamicGlossy,
                         testing::Values(GlossyCase{GlossyMethod::box, 16, 0.17, 0.055},
                                         GlossyCase{GlossyMethod::bordered, 16, 0.19, 0.27},
                                         GlossyCase{GlossyMethod::paraboloid, 16, 0.14, 0.125},
                                         GlossyCase{GlossyMethod::importance, 16, 0.13, 0.052},
                                         GlossyCase{GlossyMethod::quick, 16, 0.115, 0.053}));

// The largest step between neighbouring texels across the edges of faces, over the largest inside of faces.
double edge_step(const Cube& cube) {
  const int n = cube.size;
  double inside = 0, across = 0;
  for (int face = 0; face < 6; ++face)
    for (int k = 0; k < n; ++k) {
      for (int x = 1; x < n; ++x)
        inside = std::max(inside,
                          static_cast<double>(std::abs(cube.at(face, x, k)[0] - cube.at(face, x - 1, k)[0])));
      const CubePoint beyond = cube_point(cube_ray({face, 1 + 1.0 / n, (2 * k + 1.0) / n - 1}));
      const auto texel = [n](double s) { return std::min(n - 1, static_cast<int>((s + 1) / 2 * n)); };
      across = std::max(
          across, static_cast<double>(std::abs(cube.at(face, n - 1, k)[0] -
                                               cube.at(beyond.face, texel(beyond.s), texel(beyond.t))[0])));
    }
  return across / inside;
}

// The seam of faces that know nothing of each other, and its remedies.
TEST(DynamicGlossySeams, AreThereWhenAskedForAndNotElse) {
  const HeadlessContext context;
  {
    const CapturedRoom room(SurroundingsKind::none, CaptureInput::cube, capture_size, 1, 0);
    const Fullscreen fullscreen;
    const auto step = [&](GlossyMethod method, bool shown) {
      GlossyMaps maps({method, shown, 16, capture_size});
      maps.update(room.capture.cube(), fullscreen);
      return edge_step(probe(maps, room.capture.cube(), 0.6f, 32));
    };
    const double shown = step(GlossyMethod::box, true);
    EXPECT_GT(shown, 4);
    EXPECT_LT(step(GlossyMethod::box, false),
              1.7);  // texels at edges are narrower, steps there a little steeper
    EXPECT_LT(step(GlossyMethod::bordered, false),
              0.75 * shown);  // faces still have lobes of their own shapes
    EXPECT_LT(step(GlossyMethod::quick, false), 1.7);
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

// A mirror shows the capture itself, whatever the method.
TEST(DynamicGlossySeams, MirrorsShowTheCapture) {
  const HeadlessContext context;
  {
    const CapturedRoom room(SurroundingsKind::none, CaptureInput::cube, capture_size, 1, 0);
    const Cube radiance = room.capture.read_as_cube();
    const Fullscreen fullscreen;
    for (const GlossyMethod method : {GlossyMethod::box, GlossyMethod::bordered, GlossyMethod::quick}) {
      GlossyMaps maps({method, false, 8, capture_size});
      maps.update(room.capture.cube(), fullscreen);
      const Cube seen = probe(maps, room.capture.cube(), 0, capture_size);
      for (std::size_t i = 0; i < seen.texels.size(); ++i)
        ASSERT_NEAR(seen.texels[i], radiance.texels[i],
                    2e-3f * (1 + radiance.texels[i]) * 15);  // a look-up's weights have 8 bits
    }
  }
}

TEST(DynamicGlossyTechnique, SpheresOfOneRoughnessInAWhiteSkyAreWhite) {
  const HeadlessContext context;
  {
    Image white(64, 32);
    std::fill(white.pixels.begin(), white.pixels.end(), 1.0f);
    IblOptions options;
    options.size = 32;
    options.irradiance_size = 16;
    Material material;
    material.perceptual_roughness = 0.6f;
    const Scene scene = lone_sphere(material);
    Renderer renderer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    renderer.set_camera(scene.cameras[0]);
    renderer.set_scene(scene);
    renderer.set_environment(make_environment_data(white, options));
    renderer.resize(24, 24);
    for (const char* text : {"dynamic-glossy:around=none,size=32,method=box",
                             "dynamic-glossy:around=none,size=32,method=paraboloid",
                             "dynamic-glossy:around=none,size=32,method=quick,taps=8"}) {
      const TechniqueChoice choice = parse_technique(text);
      renderer.set_technique(*choice.technique, choice.values);
      renderer.draw();
      const Image picture = renderer.read_picture();
      int surface = 0;
      for (int i = 0; i < 24 * 24; ++i) {
        const float* pixel = picture.at(i % 24, i / 24);
        if (!lone_sphere_normal(24, i % 24, i / 24)) continue;
        ++surface;
        EXPECT_NEAR(pixel[1], 1, 3e-3f) << text;  // half floats in maps and table
      }
      EXPECT_GT(surface, 200);
    }
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

}  // namespace
}  // namespace welkin
