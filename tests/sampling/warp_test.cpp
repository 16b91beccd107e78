#include <welkin/sampling/warp.h>

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/oracles/chi_square.h"

// Each warp: its inverse undoes it, its samples follow its pdf, its pdf integrates to 1.

namespace welkin {
namespace {

struct Numbers {
  std::mt19937 random;
  Vec2f two() {
    const float x = static_cast<float>(random() >> 8) * 0x1p-24f;
    return {x, static_cast<float>(random() >> 8) * 0x1p-24f};
  }
};

// Positions in the unit square that would be uniform if the warp's density were the one it says: through the exact CDF
// in double, z for directions about +z.
std::vector<double> counts_of(const std::function<Vec2f(Vec2f)>& uniform_again) {
  std::vector<double> seen(32 * 32);
  Numbers numbers{std::mt19937(17)};
  for (int i = 0; i < 1'000'000; ++i) {
    const Vec2f at = uniform_again(numbers.two());
    seen[32 * std::clamp(static_cast<int>(at.y * 32), 0, 31) +
         std::clamp(static_cast<int>(at.x * 32), 0, 31)] += 1;
  }
  return seen;
}

float azimuth(Vec2f p) {
  return static_cast<float>(std::atan2(double{p.y}, double{p.x}) / (2 * std::numbers::pi) + 0.5);
}

TEST(Warp, SamplesFollowTheirDensity) {
  struct Case {
    std::string name;
    std::function<Vec2f(Vec2f)> uniform_again;
  };
  const std::vector<Case> cases = {
      {"disk",
       [](Vec2f u) {
         const Vec2f p = warp_to_disk(u);
         return Vec2f{p.x * p.x + p.y * p.y, azimuth(p)};
       }},
      {"cosine hemisphere",
       [](Vec2f u) {
         const Vec3f d = warp_to_cosine_hemisphere(u);
         return Vec2f{1 - d.z * d.z, azimuth({d.x, d.y})};
       }},
      {"hemisphere",
       [](Vec2f u) {
         const Vec3f d = warp_to_hemisphere(u);
         return Vec2f{1 - d.z, azimuth({d.x, d.y})};
       }},
      {"sphere",
       [](Vec2f u) {
         const Vec3f d = warp_to_sphere(u);
         return Vec2f{0.5f - 0.5f * d.z, azimuth({d.x, d.y})};
       }},
      {"cone",
       [](Vec2f u) {
         const Vec3f d = warp_to_cone(u, 0.25f);
         return Vec2f{(1 - d.z) / 0.25f, azimuth({d.x, d.y})};
       }},
      // b1 + b2 <= 1: of a point, the share of the triangle that is nearer to p0, and where on that line.
      {"triangle", [](Vec2f u) {
         const Vec2f b = warp_to_triangle(u);
         const float sum = b.x + b.y;
         return Vec2f{sum * sum, sum > 0 ? b.x / sum : 0};
       }}};
  const std::vector<double> expected(32 * 32, 1'000'000 / (32.0 * 32));
  for (const Case& one : cases)
    EXPECT_GT(oracle::chi_square(counts_of(one.uniform_again), expected).p, oracle::sidak_threshold(0.01, 6))
        << one.name;
}

TEST(Warp, InversesUndoThem) {
  Numbers numbers{std::mt19937(3)};
  for (int i = 0; i < 20000; ++i) {
    const Vec2f u =
        i < 4 ? Vec2f{i & 1 ? largest_below_1 : 0.0f, i & 2 ? largest_below_1 : 0.0f} : numbers.two();
    // The azimuth of a direction near its pole is lost, and both ends of its range are one place.
    const auto near = [&](Vec2f back, bool wraps, const char* name) {
      const float apart = std::fabs(back.y - u.y), around = wraps ? std::min(apart, 1 - apart) : apart;
      ASSERT_NEAR(back.x, u.x, 1e-5) << name << " " << u.x << " " << u.y;
      ASSERT_LT(wraps && u.x < 1e-6f ? 0 : around, 1e-5) << name << " " << u.x << " " << u.y;
      ASSERT_TRUE(back.x >= 0 && back.x < 1 && back.y >= 0 && back.y < 1) << name;
    };
    near(unwarp_disk(warp_to_disk(u)), false, "disk");
    near(unwarp_cosine_hemisphere(warp_to_cosine_hemisphere(u)), false, "cosine hemisphere");
    near(unwarp_hemisphere(warp_to_hemisphere(u)), true, "hemisphere");
    near(unwarp_sphere(warp_to_sphere(u)), true, "sphere");
    near(unwarp_cone(warp_to_cone(u, 1e-5f), 1e-5f), true, "cone");
    const Vec2f b = unwarp_triangle(warp_to_triangle(u));
    ASSERT_NEAR(b.x, u.x, 1e-6);
    ASSERT_NEAR(b.y, u.y, 1e-6);
  }
}

TEST(Warp, DirectionsAreUnitAndInTheirDomain) {
  Numbers numbers{std::mt19937(4)};
  for (int i = 0; i < 20000; ++i) {
    const Vec2f u = numbers.two(), b = warp_to_triangle(u);
    ASSERT_NEAR(length(warp_to_sphere(u)), 1, 1e-6);
    ASSERT_NEAR(length(warp_to_cosine_hemisphere(u)), 1, 1e-6);
    ASSERT_GE(warp_to_cosine_hemisphere(u).z, 0);
    ASSERT_NEAR(length(warp_to_cone(u, 0.01f)), 1, 1e-6);
    ASSERT_GE(warp_to_cone(u, 0.01f).z, 1 - 0.01f);
    ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.x + b.y <= 1);
  }
}

TEST(Warp, PdfsIntegrateToOne) {
  // Uniform ones: 1 / measure. The cosine's: the midpoint rule in z is exact.
  EXPECT_NEAR(disk_pdf() * std::numbers::pi, 1, 1e-6);
  EXPECT_NEAR(hemisphere_pdf() * 2 * std::numbers::pi, 1, 1e-6);
  EXPECT_NEAR(sphere_pdf() * 4 * std::numbers::pi, 1, 1e-6);
  EXPECT_NEAR(cone_pdf(0.3f) * 2 * std::numbers::pi * 0.3, 1, 1e-6);
  EXPECT_NEAR(triangle_pdf(7) * 7, 1, 1e-6);
  double sum = 0;
  for (int i = 0; i < 100; ++i)
    sum += cosine_hemisphere_pdf({0, 0, (static_cast<float>(i) + 0.5f) / 100}) * 2 * std::numbers::pi / 100;
  EXPECT_NEAR(sum, 1, 1e-6);
  EXPECT_EQ(cosine_hemisphere_pdf({0, 0, -0.5f}), 0);
}

}  // namespace
}  // namespace welkin
