#include <welkin/sphere/sphere_points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/sampling/sequence.h>

namespace welkin {
namespace {

// 1/g = 0.7548776662466927 and 1/g^2 = 0.5698402909980533 (Roberts 2018).
TEST(R2, FollowsThePublishedSteps) {
  EXPECT_EQ(r2_point(0)[0], 0.5);
  EXPECT_EQ(r2_point(0)[1], 0.5);
  EXPECT_NEAR(r2_point(1)[0], 0.5 + 0.7548776662466927 - 1, 1e-15);
  EXPECT_NEAR(r2_point(1)[1], 0.5 + 0.5698402909980533 - 1, 1e-15);
}

TEST(Hammersley, MirrorsBits) {
  EXPECT_EQ(radical_inverse_base2(1), 0.5);
  EXPECT_EQ(radical_inverse_base2(6), 0.375);  // 110 -> 0.011
  EXPECT_EQ(hammersley_point(3, 8)[0], 0.375);
  EXPECT_EQ(hammersley_point(3, 8)[1], 0.75);
}

// Uniform on the sphere: the mean of d is 0 and of d_i d_j is 1/3 or 0. 1e-3 is 30 times 1/n, and a third of the
// 3e-3 that random points would give.
TEST(SpherePoints, HaveTheMomentsOfTheSphere) {
  const auto points = sphere_points(30'000, 7);
  Vec3 mean, squares, products;
  for (Vec3 p : points) {
    ASSERT_NEAR(length(p), 1, 1e-14);
    mean = mean + p;
    squares = squares + Vec3{p.x * p.x, p.y * p.y, p.z * p.z};
    products = products + Vec3{p.y * p.z, p.z * p.x, p.x * p.y};
  }
  const double n = static_cast<double>(points.size());
  EXPECT_LT(length((1 / n) * mean), 1e-3);
  EXPECT_LT(length((1 / n) * products), 1e-3);
  EXPECT_LT(length((1 / n) * squares - Vec3{1 / 3.0, 1 / 3.0, 1 / 3.0}), 1e-3);
}

TEST(SpherePoints, AreTheSameEachTimeAndDifferWithTheSeed) {
  const auto a = sphere_points(10, 3), b = sphere_points(20, 3), c = sphere_points(10, 4);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].x, b[i].x);
    EXPECT_NE(a[i].x, c[i].x);
  }
}

}  // namespace
}  // namespace welkin
