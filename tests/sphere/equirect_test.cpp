#include <welkin/sphere/equirect.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace welkin {
namespace {

TEST(Equirect, TexelSolidAnglesAddUpToTheSphere) {
  for (int height : {1, 3, 64}) {
    double sum = 0;
    for (int y = 0; y < height; ++y) sum += 7 * equirect_texel_solid_angle(7, height, y);
    EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-12);
  }
}

TEST(Equirect, TexelMomentsAreTheIntegralsOfTheDirection) {
  constexpr int width = 12, height = 5, parts = 400;
  Vec3 whole;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Vec3 sum;
      for (int j = 0; j < parts; ++j) {
        const Vec3 d = equirect_direction({(x + 0.5) / width, (y + (j + 0.5) / parts) / height});
        sum = sum + equirect_texel_solid_angle(width, height * parts, y * parts + j) * d;
      }
      // The midpoint rule in theta; in phi the mean over the texel shortens the horizontal part by this.
      const double half = std::numbers::pi / width, shorter = std::sin(half) / half;
      const Vec3 moment = equirect_texel_moment(width, height, x, y);
      EXPECT_NEAR(moment.x, shorter * sum.x, 1e-6);
      EXPECT_NEAR(moment.y, sum.y, 1e-6);
      EXPECT_NEAR(moment.z, shorter * sum.z, 1e-6);
      whole = whole + moment;
    }
  EXPECT_NEAR(length(whole), 0, 1e-14);
}

}  // namespace
}  // namespace welkin
