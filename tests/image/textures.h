#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <welkin/image/image.h>
#include <welkin/image/packed_formats.h>

// Inputs for the texture codecs, and the error that each format may make.

namespace welkin {

/// Values between about 1e-3 and 3000, all different, the same on every machine.
inline float test_value(std::mt19937& random) {
  const double unit = static_cast<double>(random()) / 4294967296.0;
  return static_cast<float>(std::exp2(21.5 * unit - 10));
}

inline CubeMips test_cube(int size, bool full_chain, int channels = 3) {
  std::mt19937 random(static_cast<std::uint32_t>(size));
  CubeMips cube;
  for (int side = size;; side = std::max(1, side / 2)) {
    cube.levels.emplace_back(side, channels);
    for (float& value : cube.levels.back().texels) value = test_value(random);
    if (side == 1 || !full_chain) return cube;
  }
}

inline Image test_image(int width, int height, int channels = 3) {
  std::mt19937 random(99);
  Image image(width, height, channels);
  for (float& value : image.pixels) value = test_value(random);
  return image;
}

/// The most that the format's rounding may change a channel of a pixel whose largest stored channel is `largest`.
/// Half: half of the unit 2^(e - 10) (values here are normal). rgb9e5: half of the unit 2^(e - 8), e from the largest
/// channel, twice that where it carries into the next exponent. r11g11b10f: half of 2^(e - 5), blue's unit. Channels that a format lacks are not asked for.
inline double rounding(PixelFormat format, double value, double largest) {
  if (format == PixelFormat::rgba32f || format == PixelFormat::rg32f) return 0;
  if (format == PixelFormat::rgb9e5) return std::exp2(std::ceil(std::log2(largest + 1e-30)) - 8) * 0.5;
  const double unit_of_half = std::exp2(std::floor(std::log2(value))) / 1024;
  if (format == PixelFormat::r11g11b10f) return std::max(32 * unit_of_half * 0.5, 0x1p-20);
  return std::max(unit_of_half * 0.5, 0x1p-25);
}

}  // namespace welkin
