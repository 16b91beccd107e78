#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/pathtrace/estimates.h"

namespace welkin {
namespace {

using oracle::constant_environment;
using oracle::Estimate;
using oracle::picture_luminance;

/// A sphere that loses no light, of every model.
Material lossless(MaterialModel model) {
  Material m;
  m.model = model;
  m.base_color = {1, 1, 1};
  m.perceptual_roughness = 0.5f;
  m.metallic = 1;
  m.exponent = 20;
  m.sigma_radians = 0.4f;
  m.eta = {1, 1, 1};
  m.k = {1e6f, 1e6f, 1e6f};
  m.ior = 1e7f;
  return m;
}

Scene one_sphere(const Material& material) {
  Scene scene;
  scene.source = "furnace";
  scene.materials.push_back(material);
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  return scene;
}

Camera facing_sphere() {
  Camera camera;
  camera.to_world.origin = {0, 0, 5};
  camera.vertical_field_radians = 0.2f;
  return camera;
}

using Case = std::tuple<MaterialModel, Integrator, LightSampling>;
class Furnace : public testing::TestWithParam<Case> {};

TEST_P(Furnace, LosslessSphereCannotBeSeen) {
  const auto& [model, integrator, sampling] = GetParam();
  const Scene scene = one_sphere(lossless(model));
  const EnvironmentSampler sky = constant_environment({1, 1, 1});
  const RenderScene render(scene, &sky);
  IntegratorOptions options;
  options.integrator = integrator;
  options.sampling = sampling;
  const Estimate e = picture_luminance(render, facing_sphere(), {9, 9}, 1024, options);
  // Towards lights alone the estimate of a narrow lobe is noisy: there the pixels' own scatter (6 standard errors, a
  // chance of 2e-9) is the tolerance.
  const double noise = sampling == LightSampling::light ? 6 * e.standard_error : 0;
  EXPECT_NEAR(e.mean, 1, std::max(1e-3, noise)) << "standard error " << e.standard_error;
  EXPECT_LT(e.standard_error, 0.02);
}

INSTANTIATE_TEST_SUITE_P(All, Furnace,
                         testing::Combine(testing::Values(MaterialModel::metallic_roughness,
                                                          MaterialModel::lambert, MaterialModel::oren_nayar,
                                                          MaterialModel::phong, MaterialModel::blinn_phong,
                                                          MaterialModel::lafortune, MaterialModel::ggx,
                                                          MaterialModel::ggx_conductor, MaterialModel::mirror,
                                                          MaterialModel::conductor, MaterialModel::dielectric,
                                                          MaterialModel::coated_diffuse),
                                          testing::Values(Integrator::direct, Integrator::path),
                                          testing::Values(LightSampling::bsdf, LightSampling::light,
                                                          LightSampling::mis, LightSampling::product)));

}  // namespace
}  // namespace welkin
