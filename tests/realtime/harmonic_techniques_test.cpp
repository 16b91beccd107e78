#include <gtest/gtest.h>

#include "sphere_picture.h"

#include <numbers>
#include <string>

#include <welkin/brdf/models.h>
#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/gl/shader_text.h>
#include <welkin/sh/projection.h>

namespace welkin {
namespace {

const char* const techniques_of_nine[] = {"sh-pixel", "sh-matrix"};

Material gray() {
  Material material;
  material.model = MaterialModel::lambert;
  material.base_color = {0.5f, 0.5f, 0.5f};
  return material;
}

// What nine coefficients of the map give, in double.
std::vector<double> irradiance_of_nine(const Image& radiance, std::span<const SpherePixel> pixels) {
  ShCoefficients sh = project_equirect(radiance, 2);
  const double a[3] = {std::numbers::pi, 2 * std::numbers::pi / 3, std::numbers::pi / 4};
  for (int l = 0, i = 0; l <= 2; ++l)
    for (int m = -l; m <= l; ++m, ++i)
      for (int c = 0; c < 3; ++c) sh.values[static_cast<std::size_t>(3 * i + c)] *= a[l];
  std::vector<double> out(3 * pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    evaluate(sh, pixels[i].query.normal, std::span(out).subspan(3 * i, 3));
    for (std::size_t c = 0; c < 3; ++c)
      out[3 * i + c] = std::max(0.0, 0.5 / std::numbers::pi * out[3 * i + c]);
  }
  return out;
}

TEST(HarmonicTechniques, AConstantSkyShowsTheAlbedo) {
  const HeadlessContext context;
  const auto light = small_maps(constant_environment(1, 2, 4));
  for (const char* technique : techniques_of_nine) {
    const Image picture = draw_sphere(technique, gray(), light);
    const auto pixels = sphere_pixels({}, 3, 0.1);
    ASSERT_GT(pixels.size(), 100u);
    for (const SpherePixel& pixel : pixels) {  // single precision of ten terms
      EXPECT_NEAR(picture.at(pixel.x, pixel.y)[0], 0.5f, 1e-6f) << technique;
      EXPECT_NEAR(picture.at(pixel.x, pixel.y)[2], 2.0f, 4e-6f) << technique;
    }
  }
}

// Both are the same nine numbers: off by single precision and by the normals of the mesh (3e-4 of the radius at its rim,
// where the normal turns by 3e-4 / cos_view a pixel), the vertices' by linear interpolation over 1.4 degrees as well.
TEST(HarmonicTechniques, ShowTheSumOfNineCoefficients) {
  const HeadlessContext context;
  const Image radiance = small_environment(3);
  const auto light = small_maps(radiance);
  for (const Vec3f towards : {Vec3f{0, 0, 1}, Vec3f{-1, 0.5f, -0.3f}, Vec3f{0.2f, -2, 0.5f}}) {
    const SphereView view{towards};
    const auto pixels = sphere_pixels(view, 3, 0.3);
    const auto truth = irradiance_of_nine(radiance, pixels);
    for (const char* technique : techniques_of_nine)
      EXPECT_LT(sphere_error(draw_sphere(technique, gray(), light, view), pixels, truth).largest, 2e-3)
          << technique;
  }
}

// Ramamoorthi & Hanrahan 2001: nine coefficients are within a few per cent for natural light; a lamp that outshines all
// else is their worst case (9 % on average).
TEST(HarmonicTechniques, AreNearTheIntegral) {
  const HeadlessContext context;
  const Image radiance = small_environment(5);
  const auto light = small_maps(radiance);
  const auto pixels = sphere_pixels({}, 4, 0.1);
  const auto truth = sphere_truth(radiance, make_lambert_brdf({0.5, 0.5, 0.5}), pixels);
  for (const char* technique : techniques_of_nine) {
    const SphereError error = sphere_error(draw_sphere(technique, gray(), light), pixels, truth);
    EXPECT_LT(error.mean, 0.03) << technique;
    EXPECT_GT(error.mean, 1e-4) << technique << ": nine coefficients are not exact";
  }
}

// From behind, a surface shows the irradiance of the side that is seen.
TEST(HarmonicTechniques, TheBackOfAMirroredSphereIsLitAsItsFront) {
  const HeadlessContext context;
  const auto light = small_maps(small_environment(7));
  const Scene outside = sphere_scene(gray(), {});
  for (const char* technique : techniques_of_nine) {
    Renderer renderer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    renderer.set_technique(find_technique(technique), {});
    renderer.set_scene(outside);
    renderer.set_environment(light);
    Camera inside;  // at the centre, looking along +X: sees the normal -X at the middle of the picture
    inside.to_world = {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}};
    renderer.set_camera(inside);
    renderer.resize(9, 9);
    renderer.draw();
    const Image picture = renderer.read_picture();
    const SpherePixel pixel{4, 4, {{-1, 0, 0}, {-1, 0, 0}}};
    const auto expected = irradiance_of_nine(light->radiance, std::span(&pixel, 1));
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.at(4, 4)[c], expected[c], 1e-3 * expected[c]) << technique;
  }
}

TEST(HarmonicTechniques, TurnWithTheEnvironment) {
  const HeadlessContext context;
  const auto light = small_maps(small_environment(9));
  for (const char* technique : techniques_of_nine) {
    Renderer renderer({TexelFormat::rgba32f, TexelFormat::rgba16f});
    const Scene scene = sphere_scene(gray(), {{1, 0, 0}});
    renderer.set_technique(find_technique(technique), {});
    renderer.set_camera(scene.cameras[0]);
    renderer.set_scene(scene);
    renderer.set_environment(light);
    renderer.set_rotation(90);  // about +Y, right-handed: what was along +Z comes along +X
    renderer.resize(9, 9);
    renderer.draw();
    const Image picture = renderer.read_picture();
    const SpherePixel pixel{4, 4, {{0, 0, 1}, {0, 0, 1}}};
    const auto expected = irradiance_of_nine(light->radiance, std::span(&pixel, 1));
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(picture.at(4, 4)[c], expected[c], 1e-3 * expected[c]) << technique;
  }
}

TEST(HarmonicTechniques, TheShadersConstantsAreThoseOfTheLibrary) {
  const std::string text = shader_text("constants.glsl");
  const auto constant = [&](const std::string& name) {
    const auto at = text.find(" " + name + " = ");
    if (at == std::string::npos) return 0.0;
    return std::stod(text.substr(at + name.size() + 4));
  };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(constant("PI"), pi, 1e-13);
  EXPECT_NEAR(constant("SH_0"), std::sqrt(1 / (4 * pi)), 1e-13);
  EXPECT_NEAR(constant("SH_1"), std::sqrt(3 / (4 * pi)), 1e-13);
  EXPECT_NEAR(constant("SH_2"), std::sqrt(15 / (4 * pi)), 1e-13);
  EXPECT_NEAR(constant("SH_20"), std::sqrt(5 / (16 * pi)), 1e-13);
  EXPECT_NEAR(constant("SH_22"), std::sqrt(15 / (16 * pi)), 1e-13);
  EXPECT_NEAR(constant("COSINE_0"), pi, 1e-13);
  EXPECT_NEAR(constant("COSINE_1"), 2 * pi / 3, 1e-13);
  EXPECT_NEAR(constant("COSINE_2"), pi / 4, 1e-13);
}

}  // namespace
}  // namespace welkin
