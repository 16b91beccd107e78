#include <welkin/image/range_fit.h>

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace welkin {
namespace {

const float infinity = std::numeric_limits<float>::infinity();

TEST(RangeFit, FittingValuesAreLeftAlone) {
  const std::vector<float> values = {0, 1e-6f, 65504, -65504};
  const RangeFit fit = choose_scale(values, PixelFormat::rgba16f, RangePolicy::scale);
  EXPECT_EQ(fit.stored_scale, 1);
  EXPECT_EQ(fit.clipped, 0u);
}

TEST(RangeFit, TakesTheSmallestPowerOfTwo) {
  const auto scale = [](float largest, PixelFormat format) {
    return choose_scale(std::vector<float>{1, largest, 2}, format, RangePolicy::scale).stored_scale;
  };
  EXPECT_EQ(scale(65505, PixelFormat::rgba16f), 2);
  EXPECT_EQ(scale(131008, PixelFormat::rgba16f), 2);  // 2 * 65504
  EXPECT_EQ(scale(131009, PixelFormat::rgba16f), 4);
  EXPECT_EQ(scale(-200000, PixelFormat::rg16f), 4);
  EXPECT_EQ(scale(65409, PixelFormat::rgb9e5), 2);
  EXPECT_EQ(scale(1e9f, PixelFormat::rgb9e5), 16384);  // 1e9 / 65408 = 15288.6
  EXPECT_EQ(scale(std::numeric_limits<float>::max(), PixelFormat::rgba32f), 1);
  EXPECT_EQ(scale(std::numeric_limits<float>::max(), PixelFormat::rgba16f),
            0x1p113);  // 2^128 / 65504 > 2^112
}

TEST(RangeFit, WhatNoScaleHelpsIsCounted) {
  const std::vector<float> values = {1, infinity, -infinity, std::nanf(""), -1, -1e9f, 131000};
  const RangeFit half = choose_scale(values, PixelFormat::rgba16f, RangePolicy::scale);
  EXPECT_EQ(half.stored_scale, 16384);  // for -1e9
  EXPECT_EQ(half.clipped, 3u);          // the infinities, NaN
  const RangeFit shared = choose_scale(values, PixelFormat::rgb9e5, RangePolicy::scale);
  EXPECT_EQ(shared.stored_scale, 4);  // for 131000: a negative value cannot be stored at any scale
  EXPECT_EQ(shared.clipped, 5u);
  const RangeFit full = choose_scale(values, PixelFormat::rgba32f, RangePolicy::scale);
  EXPECT_EQ(full.stored_scale, 1);
  EXPECT_EQ(full.clipped, 3u);
}

TEST(RangeFit, ClipKeepsTheScaleAndCounts) {
  const std::vector<float> values = {1, 65504, 65505, 1e9f};
  const RangeFit fit = choose_scale(values, PixelFormat::rgba16f, RangePolicy::clip);
  EXPECT_EQ(fit.stored_scale, 1);
  EXPECT_EQ(fit.clipped, 2u);
}

TEST(RangeFit, NothingFitsEverything) {
  const RangeFit fit = choose_scale(std::vector<float>{}, PixelFormat::rgb9e5, RangePolicy::scale);
  EXPECT_EQ(fit.stored_scale, 1);
  EXPECT_EQ(fit.clipped, 0u);
}

TEST(RangeFit, OneScaleForAllLevels) {
  CubeMips cube;
  cube.levels = {Cube(2), Cube(1)};
  cube.levels[0].texels[5] = 100000;
  cube.levels[1].texels[3] = 300000;
  cube.levels[1].texels[4] = infinity;
  const RangeFit fit = choose_scale(cube, PixelFormat::rgba16f, RangePolicy::scale);
  EXPECT_EQ(fit.stored_scale, 8);
  EXPECT_EQ(fit.clipped, 1u);
}

// The prediction of choose_scale is what the encoder does, and the scale costs a relative error of half a unit.
TEST(RangeFit, AgreesWithTheEncoder) {
  std::vector<float> values(300000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = std::exp2(static_cast<float>(i % 3000) / 100 - 5);
  values[7] = infinity;
  values[8] = -2;
  for (const PixelFormat format : {PixelFormat::rgba16f, PixelFormat::rgb9e5, PixelFormat::rgba32f}) {
    for (const RangePolicy policy : {RangePolicy::scale, RangePolicy::clip}) {
      const RangeFit fit = choose_scale(values, format, policy);
      std::vector<std::uint8_t> bytes(values.size() / 3 * pixel_layout(format).bytes());
      const auto factor = static_cast<float>(1 / fit.stored_scale);
      EXPECT_EQ(encode_pixels(values, 3, factor, format, bytes), fit.clipped) << pixel_format_name(format);
    }
  }
}

// A dim map keeps its digits: without a scale 3e-8 would be half of the smallest half float.
TEST(RangeFit, ScalesDimDataUp) {
  const std::vector<float> values{3e-8f, 1e-5f};
  const RangeFit fit = choose_scale(values, PixelFormat::rgba16f, RangePolicy::scale);
  EXPECT_LT(fit.stored_scale, 1);
  EXPECT_GE(1e-5 / fit.stored_scale, 0.5);
  EXPECT_LT(1e-5 / fit.stored_scale, 1);
  EXPECT_EQ(fit.clipped, 0u);
  EXPECT_EQ(choose_scale(values, PixelFormat::rgba32f, RangePolicy::scale).stored_scale, 1);
  EXPECT_EQ(choose_scale(values, PixelFormat::rgba16f, RangePolicy::clip).stored_scale, 1);
  EXPECT_EQ(choose_scale(std::vector<float>{0.0f}, PixelFormat::rgba16f, RangePolicy::scale).stored_scale, 1);
  EXPECT_EQ(choose_scale(std::vector<float>{0.5f}, PixelFormat::rgb9e5, RangePolicy::scale).stored_scale, 1);
}

}  // namespace
}  // namespace welkin
