#include <welkin/realtime/bump_maps.h>

#include <gtest/gtest.h>

#include <cmath>

#include <welkin/error.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/renderer.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/bump_textures.h>

namespace welkin {
namespace {

Texture tilted(int width, int height, Vec3f normal) {
  Texture texture{"tilted", Image(width, height)};
  for (int i = 0; i < width * height; ++i) {
    float* p = &texture.image.pixels[3 * static_cast<std::size_t>(i)];
    p[0] = 0.5f + 0.5f * normal.x, p[1] = 0.5f + 0.5f * normal.y, p[2] = 0.5f + 0.5f * normal.z;
  }
  return texture;
}

TEST(BumpMaps, OneTiltHasItsSlopeAndNoSpreadAtEveryLevel) {
  const BumpMaps maps = make_bump_maps(tilted(5, 3, {0.48f, -0.36f, 0.8f}), 0.5f);
  ASSERT_EQ(maps.slopes.size(), 3u);  // 5 x 3, 2 x 1, 1 x 1
  const float length = std::sqrt(0.24f * 0.24f + 0.18f * 0.18f + 0.64f);
  for (std::size_t level = 0; level < 3; ++level) {
    const Image& slopes = maps.slopes[level];
    for (int i = 0; i < slopes.width * slopes.height; ++i) {
      const float* s = &slopes.pixels[4 * static_cast<std::size_t>(i)];
      const float* n = &maps.normals[level].pixels[3 * static_cast<std::size_t>(i)];
      EXPECT_NEAR(s[0], 0.3f, 1e-6f);  // rounding of floats, here and below
      EXPECT_NEAR(s[1], -0.225f, 1e-6f);
      EXPECT_NEAR(s[2], 0.09f, 1e-6f);
      EXPECT_NEAR(s[3], 0.050625f, 1e-6f);
      EXPECT_NEAR(maps.shapes[level].pixels[4 * static_cast<std::size_t>(i)], -0.0675f, 1e-6f);
      EXPECT_NEAR(n[0], 0.24f / length, 1e-6f);
      EXPECT_NEAR(n[1], -0.18f / length, 1e-6f);
      EXPECT_NEAR(n[2], 0.8f / length, 1e-6f);
    }
  }
}

// Sine waves of slope A along d: E[s s^T] = A^2 / 2 d d^T. Between texels whose phases differ by t a line has (2 + cos t) / 3 of the
// sine's mean square; that normals and not slopes are interpolated counts for the rest.
TEST(BumpMaps, WavesHaveTheMomentsOfASine) {
  const float slope = 0.4f, step = 2 * 3.14159265f / 512,
              half = 0.5f * slope * slope * (2 + std::cos(16 * step)) / 3 * (2 + std::cos(8 * step)) / 3;
  const BumpMaps maps = make_bump_maps(make_bump_texture(BumpPattern::waves, 8, slope), 1);
  const float* s = maps.slopes.back().pixels.data();
  EXPECT_NEAR(s[0], 0, 1e-5f);
  EXPECT_NEAR(s[1], 0, 1e-5f);
  EXPECT_NEAR(s[2], 0.8f * half, 0.002f * half);
  EXPECT_NEAR(s[3], 0.2f * half, 0.002f * half);
  EXPECT_NEAR(maps.shapes.back().pixels[0], -0.4f * half, 0.002f * half);
}

// The mean over everything stays, level by level, with sizes that halve badly.
TEST(BumpMaps, LevelsOfOddSizesKeepTheMean) {
  Texture texture = tilted(13, 7, {0, 0, 1});
  for (std::size_t i = 0; i < texture.image.pixels.size(); ++i)
    texture.image.pixels[i] = 0.5f + 0.4f * std::sin(1.7f * static_cast<float>(i * i % 97)) * (i % 3 != 2) +
                              0.5f * static_cast<float>(i % 3 == 2);
  const BumpMaps maps = make_bump_maps(texture, 1);
  const auto mean = [](const Image& image, int channel) {
    double sum = 0;
    for (int i = 0; i < image.width * image.height; ++i) sum += image.pixels[4 * i + channel];
    return sum / (image.width * image.height);
  };
  for (const Image& level : maps.slopes)
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(mean(level, c), mean(maps.slopes[0], c), 1e-6) << level.width;
}

TEST(BumpMaps, RefusesWhatIsNoNormalMap) {
  Texture gray{"gray", Image(2, 2, 1)};
  EXPECT_THROW(make_bump_maps(gray, 1), Error);
  EXPECT_THROW(make_bump_maps(Texture{}, 1), Error);
}

// A dim sky, a bright horizon and a row of windows.
std::shared_ptr<const EnvironmentData> windows() {
  Image image(128, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const bool window = y > 14 && y < 28 && x % 16 < 5;
      const float sky = y < 32 ? 0.3f + 0.02f * static_cast<float>(y) : 0.1f;
      float* p = image.at(x, y);
      p[0] = sky + 3.0f * window, p[1] = sky + 2.5f * window, p[2] = 1.2f * sky + 2.0f * window;
    }
  IblOptions options;
  options.size = 64;
  options.irradiance_size = 8;
  return make_environment_data(std::move(image), options);
}

class Bumpy {
 public:
  Bumpy() : renderer_({TexelFormat::rgba32f, TexelFormat::rgba16f}) {
    renderer_.show_background = false;
    static const auto light = windows();
    renderer_.set_environment(light);
    renderer_.resize(36, 24);
  }

  Image draw(const Scene& scene, std::string_view technique, int frames = 1) {
    const TechniqueChoice choice = parse_technique(technique);
    renderer_.set_technique(*choice.technique, choice.values);
    renderer_.set_camera(scene.cameras[0]);
    renderer_.set_scene(scene);
    for (int i = 0; i < frames; ++i) renderer_.draw();
    return renderer_.read_picture();
  }

 private:
  HeadlessContext context_;
  Renderer renderer_;
};

double relative_rms(const Image& picture, const Image& truth) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (i % 4 == 3 || truth.pixels[i | 3] == 0) continue;
    error += std::pow(picture.pixels[i] - truth.pixels[i], 2.0);
    size += std::pow(truth.pixels[i], 2.0);
  }
  return std::sqrt(error / size);
}

// The scene at 36 x 24 pixels, with its normal map `minified` to 1 / 8 in the middle: 2.98 m of the plane to the picture's height there.
Scene small_scene(const std::string& parameters) {
  return make_built_in_scene("bumpy:bumps=16,slope=0.3,tiling=0.503," + parameters);
}

TEST(BumpTechniques, FarFromTheSurfaceWiderLobesAreNearTheTruth) {
  Bumpy bumpy;
  for (const char* alpha : {"0", "0.01"}) {
    const Scene scene = small_scene(std::string("pattern=noise,alpha=") + alpha);
    const Image truth = bumpy.draw(scene, "bump-supersampled:samples=256");
    const double naive = relative_rms(bumpy.draw(scene, "bump-naive"), truth),
                 toksvig = relative_rms(bumpy.draw(scene, "toksvig"), truth),
                 lean = relative_rms(bumpy.draw(scene, "lean"), truth);
    EXPECT_LT(toksvig, 0.7 * naive) << alpha;
    EXPECT_LT(lean, 0.7 * naive) << alpha;
  }
}

// At an eighth's minification the bumps under a pixel are mostly one slope's rise: a long footprint, which four look-ups follow and a round
// lobe does not. On photographs the ratios are 0.3 to 0.7 (docs/realtime-bump.md); 0.8 leaves a margin for this map.
TEST(BumpTechniques, TheCovariancesFootprintIsNearerThanAnyRoundLobe) {
  Bumpy bumpy;
  for (const char* pattern : {"noise", "waves"}) {
    const Scene scene = small_scene(std::string("alpha=0.09,pattern=") + pattern);
    const Image truth = bumpy.draw(scene, "bump-supersampled:samples=256");
    const double schilling = relative_rms(bumpy.draw(scene, "schilling"), truth);
    EXPECT_LT(schilling, 0.8 * relative_rms(bumpy.draw(scene, "toksvig"), truth)) << pattern;
    EXPECT_LT(schilling, 0.8 * relative_rms(bumpy.draw(scene, "lean"), truth)) << pattern;
  }
}

// A flat map leaves every technique what the plain one is: half floats of the normal map and a spread of rounding errors remain.
TEST(BumpTechniques, AFlatMapChangesNothing) {
  Bumpy bumpy;
  const Scene scene = make_built_in_scene("bumpy:slope=0,alpha=0.09");
  const Image plain = bumpy.draw(scene, "prefiltered-ggx");
  for (const char* technique : {"bump-naive", "bump-naive:mips=none", "toksvig", "lean", "schilling"})
    EXPECT_LT(relative_rms(bumpy.draw(scene, technique), plain), 2e-3) << technique;
}

TEST(BumpTechniques, SamplesAddUpFromFrameToFrame) {
  Bumpy bumpy;
  const Scene scene = small_scene("alpha=0,pattern=waves");
  const Image at_once = bumpy.draw(scene, "bump-supersampled:samples=192");
  const Image one_by_one = bumpy.draw(scene, "bump-supersampled:samples=64", 3);
  EXPECT_LT(relative_rms(one_by_one, at_once), 1e-6);  // the same samples in the same order
  const Image fewer = bumpy.draw(scene, "bump-supersampled:samples=64");
  EXPECT_GT(relative_rms(fewer, at_once), 1e-4);
}

TEST(BumpTechniques, NothingIsLeftInOpenGl) {
  {
    Bumpy bumpy;
    for (const char* technique : {"bump-naive", "toksvig", "lean", "schilling", "bump-supersampled"})
      bumpy.draw(small_scene("alpha=0"), technique);
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

}  // namespace
}  // namespace welkin
