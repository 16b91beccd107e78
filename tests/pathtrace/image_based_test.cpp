#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <welkin/brdf/scatter/scatter_spec.h>
#include <welkin/pathtrace/image_based.h>

#include "tests/pathtrace/estimates.h"

namespace welkin {
namespace {

using oracle::Tally;

// Random texels, a sun among them.
Image random_map() {
  Image map(32, 16);
  std::mt19937 random(4);
  for (float& p : map.pixels) p = static_cast<float>(random() >> 8) * 0x1p-24f;
  for (int c = 0; c < 3; ++c) map.pixels[(4 * 32 + 9) * 3 + c] = 200;
  return map;
}

ImageBasedLight light_of(const Image& map, DfgForm form = DfgForm::scale_bias) {
  IblOptions options;
  options.size = 64;
  options.irradiance_size = 64;
  options.dfg_form = form;
  return make_image_based_light(make_ibl(map, options), options);
}

Image constant_map(float radiance) {
  Image map(16, 8);
  for (float& p : map.pixels) p = radiance;
  return map;
}

const Vec3f normal{0, 0.6f, 0.8f};

Vec3f view_of(float cosine) {
  const float s = std::sqrt(1 - cosine * cosine);
  return cosine * normal + s * Vec3f{1, 0, 0};
}

// Under a constant environment L both halves of the split sum are exact: L (f0 scale + bias), and so on. The table's own
// error is 0.002 where cos and roughness are above 0.1 (dfg.h).
TEST(ImageBased, ConstantEnvironmentsGiveTheAnalyticValue) {
  const ImageBasedLight light = light_of(constant_map(2));
  for (const float c : {0.2f, 0.5f, 0.95f})
    for (const float alpha : {0.04f, 0.3f, 1.0f}) {
      const DfgValue dfg = integrate_dfg(c, alpha);
      Scatter s;
      s.model = ScatterModel::ggx;
      s.alpha_x = s.alpha_y = alpha;
      s.color = {0.9f, 0.5f, 0.1f};
      const Rgb metal = image_based_radiance(light, s, normal, view_of(c));
      EXPECT_NEAR(metal.g, 2 * (0.5 * dfg.scale + dfg.bias), 0.004) << c << " " << alpha;
      s.model = ScatterModel::metallic_roughness;
      s.metallic = 0.5f;
      const Rgb mixed = image_based_radiance(light, s, normal, view_of(c));
      const double coat = 0.04 * dfg.scale + dfg.bias, f0 = 0.5 * 0.04 + 0.5 * 0.9;
      EXPECT_NEAR(mixed.r, 2 * (f0 * dfg.scale + dfg.bias + 0.5 * 0.9 * (1 - coat)), 0.006)
          << c << " " << alpha;
      s.compensated = true;
      s.metallic = 1;
      s.color = {1, 1, 1};
      EXPECT_NEAR(image_based_radiance(light, s, normal, view_of(c)).r, 2, 1e-4);  // white is white
    }
  EXPECT_NEAR(image_based_radiance(light, parse_scatter("lambert:0.5").scatter, normal, view_of(0.3f)).r, 1,
              1e-4);
  EXPECT_NEAR(image_based_radiance(light, parse_scatter("mirror:0.5").scatter, normal, view_of(0.3f)).r, 1,
              1e-5);
  const double f = 0.04 + 0.96 * std::pow(0.7, 5);  // Schlick's, as engines have it
  EXPECT_NEAR(image_based_radiance(light, parse_scatter("dielectric:1.5").scatter, normal, view_of(0.3f)).r,
              2 * f, 1e-5);
}

TEST(ImageBased, TablesWithMultipleScatteringAreNotCompensatedAgain) {
  const ImageBasedLight light = light_of(constant_map(1), DfgForm::scale_bias_with_multiple_scattering);
  Scatter s = parse_scatter("ggx:0.8,1,compensated").scatter;
  EXPECT_NEAR(image_based_radiance(light, s, normal, view_of(0.5f)).r, 1, 1e-4);
}

Scene one_sphere(const Scatter& of) {
  Scene scene;
  scene.source = "sphere";
  Material m;
  m.model = MaterialModel::lambert;
  m.base_color = of.color;
  scene.materials.push_back(m);
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  return scene;
}

// A lone Lambert sphere is what the irradiance map describes exactly but for its texels: the map is smooth, 64 texels
// a face, and bilinear look-ups of a function of degree 2 to 6 are within 5e-4 of its mean.
TEST(ImageBased, LambertSpheresAreThoseOfThePathTracer) {
  const Image map = random_map();
  const ImageBasedLight light = light_of(map);
  const Scene scene = one_sphere(parse_scatter("lambert:0.7").scatter);
  const EnvironmentSampler sky{Image(map)};
  const RenderScene render(scene, &sky);
  Camera camera;
  camera.to_world.origin = {0, 0, 5};
  camera.vertical_field_radians = 0.3f;
  IntegratorOptions traced, approximate;
  approximate.integrator = Integrator::image_based;
  approximate.image_based = &light;
  constexpr int size = 6;
  Tally difference;
  double mean = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const auto pixel = [&](const IntegratorOptions& options) {
        return oracle::pixel_luminance(render, camera, {size, size}, x, y, 512, options);
      };
      const double truth = pixel(traced);
      difference.add(pixel(approximate) - truth);
      mean += truth / (size * size);
    }
  const oracle::Estimate e = difference.estimate();
  EXPECT_NEAR(e.mean, 0, 4 * e.standard_error + 5e-4 * mean);
  EXPECT_LT(e.standard_error, 0.01 * mean);  // so that the test says something
}

TEST(ImageBased, BehindTheSceneIsTheEnvironment) {
  const Image map = constant_map(3);
  const ImageBasedLight light = light_of(map);
  const Scene scene = one_sphere({});
  const EnvironmentSampler sky{Image(map)};
  const RenderScene render(scene, &sky);
  Camera camera;
  camera.to_world.origin = {0, 0, 5};
  camera.vertical_field_radians = 1.5f;
  IntegratorOptions options;
  options.integrator = Integrator::image_based;
  options.image_based = &light;
  const PixelSample corner = render_sample(render, camera, {9, 9}, 0, 0, 0, options);
  EXPECT_EQ(corner.coverage, 0);
  EXPECT_EQ(corner.radiance.r, 3);
  const PixelSample middle = render_sample(render, camera, {9, 9}, 4, 4, 0, options);
  EXPECT_EQ(middle.coverage, 1);
  EXPECT_NEAR(middle.radiance.r, 1.5, 1e-4);
  options.show_environment = false;
  EXPECT_TRUE(is_black(render_sample(render, camera, {9, 9}, 0, 0, 0, options).radiance));
}

}  // namespace
}  // namespace welkin
