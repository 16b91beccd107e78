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
  // 1e-4 of about 410, as promised.
  for (std::size_t i = 0; i < map.pixels.size(); ++i) ASSERT_NEAR(filled.pixels[i], map.pixels[i], 0.04) << i;
}

// Beyond the pole a wave with an even number of periods comes back as it is, so rows -1 and 0 are alike and
// sin(k x) cosh(q (y + 1/2)) with cos k + cosh q = 2 is harmonic on the grid. The hole is a strip of 512 x 60 texels, the
// shape of a source at the zenith.
TEST(Inpaint, RestoresAHarmonicFunctionAroundThePole) {
  Image map(512, 256);
  const double k = 2 * std::numbers::pi * 4 / 512, q = std::acosh(2 - std::cos(k));
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x)
      for (int c = 0; c < 3; ++c)
        map.at(x, y)[c] = static_cast<float>(20 + (c + 1) * std::sin(k * x) * std::cosh(q * (y + 0.5)));
  Image filled = map;
  const auto texels = rectangle(map, 0, 0, 512, 60);
  for (std::uint32_t t : texels) filled.pixels[3 * t] = 1e6f;
  inpaint(filled, texels);
  // 1e-4 of the surroundings' 20 + 3 cosh(60 q) = 49.
  for (std::size_t i = 0; i < map.pixels.size(); ++i)
    ASSERT_NEAR(filled.pixels[i], map.pixels[i], 0.005) << i;
}

TEST(Inpaint, TakesMapsOfOneColumnOneRowAndOddWidth) {
  for (const auto& [width, height] : {std::pair{1, 9}, std::pair{9, 1}, std::pair{2, 2}, std::pair{7, 3}}) {
    Image map = constant_map(width, height, 2);
    const std::vector<std::uint32_t> texels = {0, 1};
    for (std::uint32_t t : texels) map.pixels[3 * t] = 50;
    inpaint(map, texels);
    for (float v : map.pixels) EXPECT_NEAR(v, 2, 1e-5f) << width << " x " << height;
  }
}

TEST(Inpaint, OfNothingDoesNothing) {
  const Image map = noise_map(16, 8, 7);
  Image filled = map;
  inpaint(filled, {});
  EXPECT_EQ(filled.pixels, map.pixels);
}

TEST(Inpaint, StaysBetweenTheSurroundingsAndLeavesTheRestAlone) {
  const Image map = noise_map(64, 32, 5);
  Image filled = map;
  const auto texels = rectangle(map, 20, 0, 30, 12);  // up to the pole
  inpaint(filled, texels);
  std::vector<bool> inside(64 * 32);
  for (std::uint32_t t : texels) inside[t] = true;
  float least = 1e30f, most = 0;  // of the rows and columns beside the rectangle
  for (std::uint32_t t : rectangle(map, 19, 0, 32, 13))
    if (!inside[t])
      for (int c = 0; c < 3; ++c)
        least = std::min(least, map.pixels[3 * t + c]), most = std::max(most, map.pixels[3 * t + c]);
  for (std::uint32_t t : rectangle(map, 52, 0, 30, 1))  // across the pole
    for (int c = 0; c < 3; ++c)
      least = std::min(least, map.pixels[3 * t + c]), most = std::max(most, map.pixels[3 * t + c]);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    if (!inside[i / 3]) {
      ASSERT_EQ(filled.pixels[i], map.pixels[i]);
      continue;
    }
    ASSERT_GE(filled.pixels[i], least);
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
