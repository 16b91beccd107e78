#include <welkin/pathtrace/shading.h>

#include <gtest/gtest.h>

#include <cmath>

namespace welkin {
namespace {

Scatter scatter_of(float ior) {
  Scene scene;
  Material material;
  material.base_color = {0.5f, 0.5f, 0.5f};
  material.metallic = 0;
  material.ior = ior;
  scene.materials.push_back(material);
  return ShadingMaterials(scene)[0].scatter;
}

// An index of 1 is no interface: Schlick's term with f90 = 1 would still reflect at grazing angles.
TEST(Shading, IndexOfOneLeavesLambertAlone) {
  const Scatter scatter = scatter_of(1);
  for (const float cos_light : {0.02f, 0.3f, 1.0f}) {
    const Vec3f light{std::sqrt(1 - cos_light * cos_light), 0, cos_light};
    EXPECT_NEAR(evaluate(scatter, light, normalized({-0.9f, 0.1f, 0.1f})).g, 0.5 / 3.14159265 * cos_light,
                1e-6)
        << cos_light;
  }
}

TEST(Shading, SchlicksGrazingReflectanceFallsOnlyBelowWater) {
  EXPECT_FLOAT_EQ(scatter_of(1.5f).f90, 1);
  EXPECT_NEAR(scatter_of(1.5f).f0, 0.04, 1e-7);
  EXPECT_FLOAT_EQ(scatter_of(1.33f).f90, 1);
  EXPECT_NEAR(scatter_of(1.1f).f90, 50 * (0.1 / 2.1) * (0.1 / 2.1), 1e-6);
}

}  // namespace
}  // namespace welkin
