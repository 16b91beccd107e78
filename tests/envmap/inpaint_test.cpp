#include <welkin/envmap/inpaint.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maps.h"

namespace welkin {
namespace {

// Texels of a rectangle; x counts round the map.
std::vector<std::uint32_t> rectangle(const Image& map, int x0, int y0, int width, int height) {
  std::vector<std::uint32_t> texels;
  for (int y = y0; y < y0 + height; ++y)
    for (int x = x0; x < x0 + width; ++x)
      texels.push_back(static_cast<std::uint32_t>(y * map.width + (x + map.width) % map.width));
  return texels;
}

// exp(k x) sin(k y) has the discrete Laplacian zero where cosh(k) + cos(k') = 2; on the seam only what is periodic can
// be tested, so: sin(k x) exp(q y) with cos k + cosh q = 2.
TEST(Inpaint, RestoresAHarmonicFunctionAcrossTheSeam) {
  Image map(64, 32);
  const double k = 2 * std::numbers::pi * 3 / 64, q = std::acosh(2 - std::cos(k));
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c)
        map.at(x, y)[c] = static_cast<float>(400 + (c + 1) * std::sin(k * x) * std::exp(q * (y - 16)));
  Image filled = map;
  const auto texels = rectangle(map, -7, 9, 15, 12);
  for (std::uint32_t t : texels) filled.pixels[3 * t] = 1e6f;
  inpaint(filled, texels);
  // 1e-5 of the largest correction a sweep leaves an error of about a side's texels times that.
  for (std::size_t i = 0; i < map.pixels.size(); ++i) ASSERT_NEAR(filled.pixels[i], map.pixels[i], 0.05) << i;
}

TEST(Inpaint, StaysBetweenTheSurroundingsAndLeavesTheRestAlone) {
  const Image map = noise_map(64, 32, 5);
  Image filled = map;
  const auto texels = rectangle(map, 20, 0, 30, 12);  // up to the pole
  inpaint(filled, texels);
  std::vector<bool> inside(64 * 32);
  for (std::uint32_t t : texels) inside[t] = true;
  const float most = *std::max_element(map.pixels.begin(), map.pixels.end());
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const float kept = inside[i / 3] ? filled.pixels[i] : map.pixels[i];
    ASSERT_EQ(filled.pixels[i], kept);
    ASSERT_GE(filled.pixels[i], 0);
    ASSERT_LE(filled.pixels[i], most);
  }
  for (std::uint32_t t : texels) ASSERT_NE(filled.pixels[3 * t], map.pixels[3 * t]);
}

TEST(Inpaint, OfEveryTexelDoesNothing) {
  const Image map = noise_map(16, 8, 7);
  Image filled = map;
  inpaint(filled, rectangle(map, 0, 0, 16, 8));
  EXPECT_EQ(filled.pixels, map.pixels);
}

}  // namespace
}  // namespace welkin
