#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include <welkin/comparison/truth.h>
#include <welkin/envmap/ibl.h>
#include <welkin/sphere/cube_lookup.h>

// The truth without shadows against what is known in closed form or by sums in double.

namespace welkin {
namespace {

Image random_environment(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.1f, 1.0f);
  Image map(32, 16);
  for (float& value : map.pixels) value = uniform(random);
  for (int c = 0; c < 3; ++c) map.at(5, 3)[c] = 60;  // something small and bright
  return map;
}

Scene sphere_of(MaterialModel model, Rgb color) {
  Scene scene;
  scene.source = "sphere";
  Material material;
  material.model = model;
  material.base_color = color;
  scene.materials.push_back(material);
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  return scene;
}

// Orthographic: pixel (x, y) sees the normal (u, v, sqrt(1 - u^2 - v^2)).
Camera front_view() {
  Camera camera;
  camera.to_world.origin = {0, 0, 3};
  camera.orthographic_height = 2.0f;
  return camera;
}

constexpr PictureSize small{24, 24};

TruthPicture unshadowed(const Scene& scene, const Image& map, std::uint32_t samples) {
  TruthOptions options;
  options.samples = samples;
  return render_truth(scene, map, front_view(), small, Truth::unshadowed, options);
}

// A diffuse sphere shows albedo times E / pi of its normals; E by Greene's sum over all texels. Two spheres that stand in
// each other's light show the same: nothing is hidden and nothing bounces.
TEST(UnshadowedTruth, DiffuseSpheresShowTheIrradianceOfTheirNormals) {
  const Image map = random_environment(1);
  const Cube irradiance = irradiance_brute_force(map, 64);
  Scene scene = sphere_of(MaterialModel::lambert, {0.5f, 0.25f, 1});
  scene.spheres.push_back({{0, 2.5f, 0}, 1.4f, 0});  // above the picture, touching it nearly
  const TruthPicture truth = unshadowed(scene, map, 256);
  int compared = 0;
  double difference = 0, sum = 0;
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      const double u = (x + 0.5) / 12 - 1, v = 1 - (y + 0.5) / 12, square = u * u + v * v;
      if (square > 0.7) continue;  // nearer the edge a pixel's mean is not its middle
      float expected[3] = {};
      look_up_cube(irradiance, {u, v, std::sqrt(1 - square)}, expected);
      for (int c = 0; c < 3; ++c) {
        const double albedo[] = {0.5, 0.25, 1}, e = albedo[c] * double{expected[c]} / std::numbers::pi;
        // Seven degrees of freedom: 10 standard errors are beyond any chance of 1000 values. A hundredth: a pixel's mean is
        // not quite its middle.
        const double own = double{truth.radiance.at(x, y)[c]},
                     error = double{truth.standard_error.at(x, y)[c]};
        EXPECT_NEAR(own, e, 10 * error + 0.01 * e) << x << ' ' << y;
        difference += own - e;
        sum += e;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 250);
  EXPECT_NEAR(difference / sum, 0, 1e-3);  // noise of the mean
}

// A mirror shows the texel that its mirrored view falls into.
TEST(UnshadowedTruth, MirrorsShowTheEnvironmentBehindEverything) {
  Image map(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) map.at(x, y)[y < 16 ? 0 : 1] = 1;  // red above, green below
  Scene scene = sphere_of(MaterialModel::mirror, {1, 1, 1});
  scene.spheres.push_back({{0, 5, 0}, 2, 0});  // would be seen in the upper half
  const TruthPicture truth = unshadowed(scene, map, 16);
  // At the height v the normal is (0, v, .): the view is mirrored to y = 2 v sqrt(1 - v^2) in the middle column.
  for (int y = 2; y < 22; ++y) {
    if (y == 11 || y == 12) continue;  // the horizon passes through these
    const float* pixel = truth.radiance.at(12, y);
    EXPECT_NEAR(pixel[y < 12 ? 0 : 1], 1, 1e-4) << y;
    EXPECT_NEAR(pixel[y < 12 ? 1 : 0], 0, 1e-4) << y;
  }
}

// Lights of the scene do not count, what shines is seen.
TEST(UnshadowedTruth, OtherLightsDoNotCountAndEmissionIsSeen) {
  const Image map = random_environment(2);
  const Scene dark = sphere_of(MaterialModel::lambert, {1, 1, 1});
  Scene lit = dark;
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::directional;
  sun.direction = {0, 0, -1};
  sun.intensity = {5, 5, 5};
  lit.lights.push_back(sun);
  lit.materials.push_back(lit.materials[0]);
  lit.materials[1].emission = {9, 9, 9};
  lit.spheres.push_back({{2.5f, 0, 1}, 1, 1});  // outside of the picture
  const TruthPicture without = unshadowed(dark, map, 1024), with = unshadowed(lit, map, 1024);
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < without.radiance.pixels.size(); ++i) {
    difference += double{with.radiance.pixels[i]} - double{without.radiance.pixels[i]};
    sum += double{without.radiance.pixels[i]};
  }
  EXPECT_NEAR(difference / sum, 0, 2e-3);  // noise
  Scene shining = dark;
  shining.materials[0].emission = {3, 2, 1};
  const TruthPicture bright = unshadowed(shining, map, 64);
  EXPECT_NEAR(bright.radiance.at(12, 12)[0] - without.radiance.at(12, 12)[0], 3, 0.1);  // noise of 64 samples
}

// All strategies have the same expectation without shadows.
TEST(UnshadowedTruth, StrategiesAgree) {
  const Image map = random_environment(3);
  Scene scene = sphere_of(MaterialModel::metallic_roughness, {0.9f, 0.6f, 0.3f});
  scene.materials[0].metallic = 1;
  scene.materials[0].perceptual_roughness = 0.5f;
  double means[4] = {};
  const LightSampling strategies[] = {LightSampling::bsdf, LightSampling::light, LightSampling::mis,
                                      LightSampling::product};
  for (int i = 0; i < 4; ++i) {
    TruthOptions options;
    options.samples = 512;
    options.sampling = strategies[i];
    const TruthPicture truth = render_truth(scene, map, front_view(), small, Truth::unshadowed, options);
    for (const float value : truth.radiance.pixels) means[i] += double{value};
  }
  for (const double mean : means) EXPECT_NEAR(mean / means[2], 1, 3e-3);  // noise of the noisiest (bsdf)
}

}  // namespace
}  // namespace welkin
