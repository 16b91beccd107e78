#include <gtest/gtest.h>

#include <cmath>

#include <welkin/raytrace/texture_lookup.h>
#include "tests/raytrace/shapes.h"

namespace welkin {
namespace {

using namespace oracle;

/// A square in the plane z = 0, seen from +z, texture upright: u to the right, v down.
Mesh square() {
  Mesh mesh;
  mesh.positions = {{-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}};
  mesh.texcoords[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Surface seen(const Scene& scene, Vec3f eye, Vec3f at) {
  const RayScene rays(scene);
  const Ray ray{eye, 0, normalized(at - eye), 1e30f};
  const auto hit = rays.closest(ray);
  EXPECT_TRUE(hit);
  return surface_at(rays, *hit, ray);
}

void expect_near(Vec3f a, Vec3f b, double tolerance = 1e-5) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Surface, TangentsComeFromTextureCoordinates) {
  const Surface s = seen(scene_of(square()), {0.5f, 0.2f, 3}, {0.5f, 0.2f, 0});
  EXPECT_NEAR(s.texcoords[0].x, 0.75, 1e-5);
  EXPECT_NEAR(s.texcoords[0].y, 0.4, 1e-5);
  expect_near(s.shading.tangent, {1, 0, 0});
  expect_near(s.bitangent_sign * s.shading.bitangent, {0, 1, 0});  // a normal map's green points up
  expect_near(s.geometric_normal, {0, 0, 1});
}

TEST(Surface, MirroredPicturesTurnTheMapsHandedness) {
  Mesh mesh = square();
  for (Vec2f& t : mesh.texcoords[0]) t.x = 1 - t.x;
  const Surface s = seen(scene_of(mesh), {0, 0.2f, 3}, {0, 0.2f, 0});
  expect_near(s.shading.tangent, {-1, 0, 0});
  expect_near(s.bitangent_sign * s.shading.bitangent, {0, 1, 0});
}

// A mirrored instance shows the mirrored object: fronts stay fronts, and what was up on the map is up still.
TEST(Surface, MirroredInstancesKeepFrontsAndMaps) {
  Affine mirror;
  mirror.x = {-1, 0, 0};
  for (const bool own_tangents : {false, true}) {
    Mesh mesh = square();
    mesh.normals.assign(4, {0, 0, 1});
    if (own_tangents) {
      mesh.tangents.assign(4, {1, 0, 0});
      mesh.tangent_signs.assign(4, 1);
    }
    for (const bool twice : {false, true}) {
      std::vector<Affine> places = {mirror};
      if (twice) places.push_back(scaled(1, {0, 0, -9}));
      const Surface s = seen(scene_of(mesh, places), {0.5f, 0.2f, 3}, {0.5f, 0.2f, 0});
      EXPECT_TRUE(s.front);
      expect_near(s.geometric_normal, {0, 0, 1});
      expect_near(s.shading.normal, {0, 0, 1});
      expect_near(s.shading.tangent, {-1, 0, 0});
      expect_near(s.bitangent_sign * s.shading.bitangent, {0, 1, 0});
      EXPECT_NEAR(s.texcoords[0].x, 0.25, 1e-5);
    }
  }
}

TEST(Surface, NormalsTurnAsTheSurfaceDoesUnderUnevenScale) {
  const Mesh ball = icosphere(4);
  Affine stretched;
  stretched.x = {3, 0, 0};
  stretched.y = {0, 0.5f, 0};
  const Scene scene = scene_of(ball, {stretched});
  std::mt19937 random(1);
  for (int i = 0; i < 20; ++i) {
    const Vec3f to = random_direction(random);
    const Surface s = seen(scene, {9 * to.x, 9 * to.y, 9 * to.z}, {});
    // The ellipsoid x^2/9 + 4 y^2 + z^2 = 1 has its gradient as normal; the mesh is off by its facets, about 0.02.
    const Vec3f gradient = normalized({s.position.x / 9, 4 * s.position.y, s.position.z});
    EXPECT_GT(dot(s.shading.normal, gradient), 0.998f);
    EXPECT_GT(dot(s.geometric_normal, gradient), 0.98f);
    EXPECT_TRUE(s.front);
  }
}

TEST(Surface, SpheresHaveTheTextureCoordinatesOfTheirNormal) {
  Scene scene;
  Texture texture;
  texture.image = Image(2, 2);
  scene.textures.push_back(texture);
  scene.materials.push_back({});
  scene.materials[0].base_color_texture.texture = 0;
  scene.spheres.push_back({{1, 2, 3}, 2, 0});
  const Surface front = seen(scene, {9, 2, 3}, {1, 2, 3});  // +x: the middle
  EXPECT_NEAR(front.texcoords[0].x, 0.5, 1e-5);
  EXPECT_NEAR(front.texcoords[0].y, 0.5, 1e-5);
  const Surface side = seen(scene, {1, 2, 9}, {1, 2, 3});  // +z: three quarters
  EXPECT_NEAR(side.texcoords[0].x, 0.75, 1e-5);
  expect_near(side.shading.tangent, {-1, 0, 0});
  expect_near(side.bitangent_sign * side.shading.bitangent, {0, 1, 0});
}

TEST(TextureLookup, WrapsAndInterpolates) {
  Texture t;
  t.image = Image(4, 1, 1);
  for (int x = 0; x < 4; ++x) t.image.at(x, 0)[0] = static_cast<float>(x);
  const auto at = [&](float u) { return look_up(t, {u, 0.5f})[0]; };
  EXPECT_FLOAT_EQ(at(0.375f), 1);   // a centre
  EXPECT_FLOAT_EQ(at(0.5f), 1.5f);  // half-way
  EXPECT_FLOAT_EQ(at(0), 1.5f);     // between the last and the first
  EXPECT_FLOAT_EQ(at(-1.625f), 1);  // two periods off
  EXPECT_FLOAT_EQ(at(7.375f), 1);
  t.wrap_u = TextureWrap::clamp;
  EXPECT_FLOAT_EQ(at(-3), 0);
  EXPECT_FLOAT_EQ(at(40), 3);
  t.wrap_u = TextureWrap::mirror;
  EXPECT_FLOAT_EQ(at(1.125f), 3);
  EXPECT_FLOAT_EQ(at(-0.375f), 1);
  EXPECT_FLOAT_EQ(at(2.375f), 1);
  t.nearest = true;
  EXPECT_FLOAT_EQ(at(0.49f), 1);
  EXPECT_FLOAT_EQ(at(-0.01f), 0);
  TextureUse turn;
  turn.rotation_radians = static_cast<float>(M_PI / 2);  // the extension: counter-clockwise, v downwards
  turn.offset = {10, 20};
  turn.scale = {2, 3};
  const Vec2f moved = transformed_texcoord(turn, {1, 1});
  EXPECT_NEAR(moved.x, 13, 1e-5);
  EXPECT_NEAR(moved.y, 18, 1e-5);
}

}  // namespace
}  // namespace welkin
