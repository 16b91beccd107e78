#include <welkin/pathtrace/shading.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include <welkin/raytrace/ray_scene.h>
#include <welkin/scene/mesh_repair.h>

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

// A square that faces +Z, its texture upright: u along +X, v down. One texel of normal map over all of it.
Scene upright_square(Rgb normal_map) {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  make_tangents(mesh, 0);
  scene.meshes.push_back(mesh);
  scene.instances.push_back({});
  Texture texture;
  texture.image = Image(1, 1);
  texture.image.pixels = {normal_map.r, normal_map.g, normal_map.b};
  scene.textures.push_back(texture);
  scene.materials.emplace_back();
  scene.materials[0].normal_texture.texture = 0;
  return scene;
}

Vec3f shading_normal(const Scene& scene) {
  const RayScene rays(scene);
  const Ray ray{{0.2f, 0.3f, 5}, 0, {0, 0, -1}, 1e30f};
  const std::optional<Hit> hit = rays.closest(ray);
  ShadingPoint point;
  point.surface = surface_at(rays, hit.value(), ray);
  prepare_shading(scene, ShadingMaterials(scene), ray.direction, point);
  return point.frame.normal;
}

// glTF 2.0, section 3.9.3: red leans along +u, green towards the top of the texture.
TEST(Shading, NormalMapsLeanAsTheFormatSays) {
  const Vec3f red = shading_normal(upright_square({0.8f, 0.5f, 0.9f}));
  EXPECT_NEAR(red.x, 0.6, 1e-6);
  EXPECT_NEAR(red.y, 0, 1e-6);
  EXPECT_NEAR(red.z, 0.8, 1e-6);
  const Vec3f green = shading_normal(upright_square({0.5f, 0.8f, 0.9f}));
  EXPECT_NEAR(green.x, 0, 1e-6);
  EXPECT_NEAR(green.y, 0.6, 1e-6);
  EXPECT_NEAR(green.z, 0.8, 1e-6);
}

}  // namespace
}  // namespace welkin
