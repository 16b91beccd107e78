#include <welkin/envmap/statistics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maps.h"

#include <welkin/envmap/cube_steps.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

TEST(MapStatistics, OfAConstant) {
  for (int height : {16, 17}) {
    const MapStatistics s = map_statistics(constant_map(2 * height, height, 2));
    EXPECT_NEAR(s.mean_radiance[0], 2, 1e-12);
    EXPECT_NEAR(s.energy[1], 8 * pi, 1e-11);
    EXPECT_NEAR(s.irradiance_up[2], 2 * pi, 1e-12);
    EXPECT_NEAR(s.irradiance_down[2], 2 * pi, 1e-12);
  }
}

TEST(MapStatistics, OfOneTexel) {
  Image map(64, 32);
  map.at(10, 5)[1] = 40;
  const MapStatistics s = map_statistics(map);
  EXPECT_EQ(s.brightest_x, 10);
  EXPECT_EQ(s.brightest_y, 5);
  EXPECT_DOUBLE_EQ(s.brightest_share, 1);
  EXPECT_NEAR(dot(s.brightest_direction, equirect_direction({10.5 / 64, 5.5 / 32})), 1, 1e-15);
  EXPECT_NEAR(s.energy[1], 40 * equirect_texel_solid_angle(64, 32, 5), 1e-14);
  EXPECT_NEAR(s.irradiance_up[1] / s.energy[1], s.brightest_direction.y, 2e-3);  // the cosine over a texel
  EXPECT_EQ(s.irradiance_down[1], 0);
  EXPECT_EQ(s.max_radiance, 40);
}

// L = 1 + y: irradiance pi (1 + 2/3) above, pi (1 - 2/3) below.
TEST(MapStatistics, TellUpFromDown) {
  Image map(512, 256);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x)
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = static_cast<float>(1 + std::cos(pi * (y + 0.5) / 256));
  const MapStatistics s = map_statistics(map);
  EXPECT_NEAR(s.irradiance_up[0], pi * 5 / 3, 1e-4);  // texel size squared / 24
  EXPECT_NEAR(s.irradiance_down[0], pi / 3, 1e-4);
}

}  // namespace
}  // namespace welkin
