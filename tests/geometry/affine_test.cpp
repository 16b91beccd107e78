#include <welkin/geometry/affine.h>

#include <gtest/gtest.h>

#include <cmath>

#include <welkin/error.h>

namespace welkin {
namespace {

void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-6f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

const float half = std::sqrt(0.5f);

// A quarter turn about +Y takes +X to -Z and +Z to +X (right-handed).
TEST(Affine, NodeScalesThenTurnsThenMoves) {
  const Affine a = make_affine({10, 0, 0}, {0, half, 0}, half, {2, 3, 4});
  expect_near(a.point({1, 0, 0}), {10, 0, -2});
  expect_near(a.point({0, 1, 0}), {10, 3, 0});
  expect_near(a.point({0, 0, 1}), {14, 0, 0});
}

TEST(Affine, InverseUndoes) {
  const Affine a = make_affine({1, -2, 3}, {half, 0, 0}, half, {2, 0.5f, -4});
  expect_near((inverse(a) * a).point({0.3f, 0.7f, -0.2f}), {0.3f, 0.7f, -0.2f});
  EXPECT_THROW(inverse(make_affine({}, {}, 1, {1, 0, 1})), Error);
}

// A plane x + y = 0 stretched by 2 along x is x / 2 + y = 0: normal (1/2, 1). Mirroring keeps it pointing outwards.
TEST(Affine, NormalsStayPerpendicular) {
  const Vec3f stretched = normalized(transform_normal(make_affine({}, {}, 1, {2, 1, 1}), {half, half, 0}));
  expect_near(stretched, normalized({0.5f, 1, 0}));
  expect_near(normalized(transform_normal(make_affine({}, {}, 1, {-1, 1, 1}), {1, 0, 0})), {-1, 0, 0});
}

TEST(Affine, LookAtLooksAlongMinusZ) {
  const Affine camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  expect_near(camera.vector({0, 0, -1}), {0, 0, -1});
  expect_near(camera.vector({1, 0, 0}), {1, 0, 0});
  EXPECT_THROW(look_at({0, 1, 0}, {0, 0, 0}, {0, 1, 0}), Error);
  EXPECT_THROW(look_at({0, 1, 0}, {0, 1, 0}, {0, 0, 1}), Error);
}

}  // namespace
}  // namespace welkin
