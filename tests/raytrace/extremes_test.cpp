#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <welkin/raytrace/flush_denormals.h>
#include "tests/raytrace/shapes.h"

// Sizes at the ends of what floats hold, and rays that are no rays: nothing ends the program, and what can be answered is.

namespace welkin {
namespace {

using namespace oracle;

Scene cubes(const std::vector<Affine>& places) {
  Scene scene;
  scene.source = "test";
  scene.materials.emplace_back();
  scene.meshes.push_back(cube_mesh());
  for (const Affine& place : places) scene.instances.push_back({0, place});
  check_scene(scene);
  return scene;
}

Affine scaled(float x, float y, float z) { return {{x, 0, 0}, {0, y, 0}, {0, 0, z}, {0, 0, 0}}; }

constexpr float infinity = std::numeric_limits<float>::infinity(),
                nan = std::numeric_limits<float>::quiet_NaN();

// 1e-10 to 1e11 metres: the squares of the cube's areas are 1e-40 to 1e44. From all sides the ray meets the side that it
// is aimed at, whose normal looks back; edges of 2 and diagonals make an angle's cosine right to a few units of rounding.
TEST(ExtremesTest, PlanesOfAllSizes) {
  const FlushDenormals flush;
  for (const float size : {1e-10f, 1e-8f, 1e-5f, 1.0f, 1e6f, 1e9f, 1e11f}) {
    const Scene scene = cubes({scaled(size, size, size)});
    const RayScene rays(scene);
    for (const Vec3f side : {Vec3f{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
      const Vec3f aside{0.3f * size, 0.2f * size, 0.1f * size};
      const Ray ray{3 * size * side + aside - dot(aside, side) * side, 0, -side, 1e30f};
      const auto hit = rays.closest(ray);
      ASSERT_TRUE(hit) << size;
      const Surface surface = surface_at(rays, *hit, ray);
      EXPECT_NEAR(dot(surface.geometric_normal, side), 1, 1e-6) << size;
      EXPECT_NEAR(length(surface.geometric_normal), 1, 1e-6) << size;
      EXPECT_NEAR(dot(surface.position, side) / size, 1, 1e-5) << size;
      EXPECT_LT(surface.position_error, 1e-5f * size);
      EXPECT_TRUE(surface.front);
    }
  }
}

// One side shrunk to 1e-25: in the frame of such an instance the world is larger than floats.
TEST(ExtremesTest, InstancesThatShrinkByAnything) {
  const FlushDenormals flush;
  for (const float thin : {1e-3f, 1e-6f, 1e-9f, 1e-20f, 1e-25f}) {
    for (const float far : {10.0f, 1e6f, 1e12f}) {
      const Scene scene = cubes({scaled(1, 1, thin), scaled(thin, 1, 1)});
      const RayScene rays(scene);
      std::vector<Ray> batch;
      for (int i = 0; i < 16; ++i) batch.push_back({{0.3f, 0.2f, far}, 0, {0, 0, -1}, 1e30f});
      batch[3].origin = {far, 0.2f, 0.3f};
      batch[3].direction = {-1, 0, 0};
      Hit hits[16];
      const std::uint32_t met = rays.closest(batch, hits, RayKind::side_by_side);
      EXPECT_EQ(met, 0xffffu) << thin << " " << far;
      EXPECT_EQ(rays.occluded(batch), 0xffffu) << thin << " " << far;
    }
  }
}

TEST(ExtremesTest, RaysThatAreNoneMeetNothing) {
  const Scene scene = cubes({scaled(1, 1, 1), scaled(2, 2, 1e-3f)});
  const RayScene rays(scene);
  const Ray good{{0.3f, 0.2f, 5}, 0, {0, 0, -1}, 1e30f};
  std::vector<Ray> batch(5, good);
  batch[1].origin.x = nan;
  batch[2].direction.y = infinity;
  batch[3].far = nan;
  batch[4].origin.z = 1e30f;
  Hit hits[5];
  EXPECT_EQ(rays.closest(batch, hits, RayKind::scattered), 1u);
  EXPECT_EQ(rays.closest(batch, hits, RayKind::side_by_side), 1u);
  EXPECT_EQ(rays.occluded(batch), 1u);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    EXPECT_EQ(rays.closest(batch[i]).has_value(), i == 0) << i;
    EXPECT_EQ(rays.occluded(batch[i]), i == 0) << i;
  }
}

}  // namespace
}  // namespace welkin
