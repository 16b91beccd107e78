#include <gtest/gtest.h>

#include <cmath>

#include "tests/raytrace/shapes.h"

namespace welkin {
namespace {

using namespace oracle;

/// A square of 2 x 2 m in the plane z = 0 whose texture's alpha is 1 on the left and 0.25 on the right.
Scene half_open(AlphaMode mode, bool twice) {
  Mesh mesh;
  mesh.positions = {{-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}};
  mesh.texcoords[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<Affine> places = {{}};
  if (twice) places.push_back(scaled(1, {0, 0, -5}));
  Scene scene = scene_of(mesh, places);
  Texture texture;
  texture.image = Image(2, 1, 4);
  texture.image.at(0, 0)[3] = 1;
  texture.image.at(1, 0)[3] = 0.25f;
  texture.nearest = true;
  scene.textures.push_back(texture);
  scene.materials[0].alpha_mode = mode;
  scene.materials[0].base_color_texture.texture = 0;
  return scene;
}

Ray down(float x, float y) { return {{x, y, 3}, 0, {0, 0, -1}, 4}; }

TEST(Alpha, MasksLetRaysThrough) {
  for (const bool twice : {false, true}) {
    const Scene scene = half_open(AlphaMode::mask, twice);
    const RayScene rays(scene);
    EXPECT_TRUE(rays.closest(down(-0.5f, 0.3f)));
    EXPECT_TRUE(rays.occluded(down(-0.5f, 0.3f)));
    EXPECT_FALSE(rays.closest(down(0.5f, 0.3f)));
    EXPECT_FALSE(rays.occluded(down(0.5f, 0.3f)));
    std::vector<Ray> batch;
    for (int i = 0; i < 16; ++i)
      batch.push_back(down(i % 2 == 0 ? -0.5f : 0.5f, 0.05f * static_cast<float>(i)));
    Hit hits[RayScene::batch_size];
    EXPECT_EQ(rays.closest(batch, hits, RayKind::side_by_side), 0x5555u);
    EXPECT_EQ(rays.closest(batch, hits, RayKind::scattered), 0x5555u);
    EXPECT_EQ(rays.occluded(batch), 0x5555u);
  }
}

TEST(Alpha, BlendsAreHitAsOftenAsTheyCover) {
  const Scene scene = half_open(AlphaMode::blend, false);
  const RayScene rays(scene);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.05f, 0.95f);
  constexpr int count = 40'000;
  int left = 0, right = 0, differ = 0;
  for (int i = 0; i < count; ++i) {
    const Ray a = down(-unit(random), unit(random)), b = down(unit(random), unit(random));
    left += rays.occluded(a);
    right += rays.occluded(b);
    differ += rays.occluded(b) != rays.closest(b).has_value();
  }
  EXPECT_EQ(left, count);
  EXPECT_EQ(differ, 0);  // the same ray, the same answer
  // 5 standard deviations of a binomial of 0.25.
  EXPECT_NEAR(right, 0.25 * count, 5 * std::sqrt(count * 0.25 * 0.75));
}

TEST(Alpha, SpheresHaveHolesToo) {
  Scene scene = half_open(AlphaMode::mask, false);
  scene.instances.clear();
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  scene.materials.push_back({});
  scene.spheres.push_back({{4, 0, 0}, 1, 1});
  const RayScene rays(scene);
  // u = atan2(z, x) / 2 pi + 1/2: the open half is z > 0. A ray through both sides meets only the far one.
  const Ray ray{{0, 0.1f, 5}, 0, {0, 0, -1}, 1e30f};
  const auto hit = rays.closest(ray);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 5 + std::sqrt(0.99), 1e-5);
  EXPECT_TRUE(rays.occluded({{4, 0.1f, 5}, 0, {0, 0, -1}, 5}));  // the other sphere is whole
}

}  // namespace
}  // namespace welkin
