#include <welkin/image/codecs/texture_surface.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

#include "tests/image/textures.h"

// Formats of blocks: what comes back after encoding and decoding, for shapes with partial blocks and several faces.

namespace welkin {
namespace {

constexpr PixelFormat block_formats[] = {PixelFormat::bc6h, PixelFormat::bc6h_signed, PixelFormat::astc,
                                         PixelFormat::astc6x6};

std::string name_of(PixelFormat format) { return std::string(pixel_format_name(format)); }

std::vector<std::uint8_t> encode(PixelFormat format, std::span<const float> texels, SurfaceShape shape,
                                 std::size_t* clipped = nullptr, int channels = 3,
                                 BlockQuality quality = BlockQuality::fast, float factor = 1) {
  std::vector<std::uint8_t> bytes(shape.bytes(pixel_layout(format)));
  const std::size_t count = SurfaceEncoder(format, quality).encode(texels, shape, channels, factor, bytes);
  if (clipped) *clipped = count;
  return bytes;
}

std::vector<float> decode(PixelFormat format, std::span<const std::uint8_t> bytes, SurfaceShape shape,
                          float factor = 1) {
  std::vector<float> rgb(shape.pixels() * 3);
  SurfaceDecoder(pixel_layout(format)).decode(bytes, shape, factor, rgb, "memory");
  return rgb;
}

// Smooth in x and y, another phase for each face and channel, between 0.3 and 3.
std::vector<float> smooth(SurfaceShape shape, int channels = 3) {
  std::vector<float> texels;
  for (int face = 0; face < shape.faces; ++face)
    for (int y = 0; y < shape.height; ++y)
      for (int x = 0; x < shape.width; ++x)
        for (int c = 0; c < channels; ++c)
          texels.push_back(std::exp(std::sin(0.05f * static_cast<float>(x) + 0.07f * static_cast<float>(y) +
                                             static_cast<float>(c + face))));
  return texels;
}

double relative_rms(std::span<const float> values, std::span<const float> truth) {
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double d = static_cast<double>(values[i]) - truth[i];
    error += d * d;
    norm += static_cast<double>(truth[i]) * truth[i];
  }
  return std::sqrt(error / norm);
}

// What two lines through a block's colours can miss, where the three channels go up and down apart from each other: ASTC,
// which gives fewer bits to more end points, comes to 2 % in blocks of 4 x 4 and 3 % in 6 x 6, BC6H to 1 %.
double allowed(PixelFormat format) {
  return pixel_layout(format).component == PixelLayout::Component::astc_hdr ? 0.04 : 0.015;
}

TEST(BlockSurface, SmoothImagesComeBack) {
  for (const PixelFormat format : block_formats)
    for (const SurfaceShape shape :
         {SurfaceShape{1, 1, 6}, {2, 2, 6}, {3, 3, 1}, {7, 5, 2}, {24, 24, 6}, {61, 35, 1}}) {
      const std::vector<float> texels = smooth(shape);
      std::size_t clipped = 1;
      const std::vector<float> back = decode(format, encode(format, texels, shape, &clipped), shape);
      EXPECT_LT(relative_rms(back, texels), allowed(format)) << name_of(format) << shape.width;
      EXPECT_EQ(clipped, 0u);
    }
}

TEST(BlockSurface, FactorsAreUndone) {
  const SurfaceShape shape{16, 16, 1};
  const std::vector<float> texels = smooth(shape);
  for (const PixelFormat format : block_formats) {
    const auto bytes = encode(format, texels, shape, nullptr, 3, BlockQuality::normal, 0.125f);
    EXPECT_LT(relative_rms(decode(format, bytes, shape, 8), texels), allowed(format)) << name_of(format);
  }
}

TEST(BlockSurface, OneTwoAndFourChannels) {
  const SurfaceShape shape{8, 8, 1};
  for (const PixelFormat format : block_formats)
    for (const int channels : {1, 2, 4}) {
      const std::vector<float> texels = smooth(shape, channels);
      const std::vector<float> back = decode(format, encode(format, texels, shape, nullptr, channels), shape);
      std::vector<float> expected;
      for (std::size_t i = 0; i < shape.pixels(); ++i)
        for (int c = 0; c < 3; ++c)
          expected.push_back(channels == 1  ? texels[i]
                             : c < channels ? texels[i * static_cast<std::size_t>(channels) + c]
                                            : 0.0f);
      EXPECT_LT(relative_rms(back, expected), allowed(format)) << name_of(format) << channels;
    }
}

// Random values, one texel in forty as bright as a lamp: nothing that comes back may be brighter than its block.
TEST(BlockSurface, NothingIsBrighterThanItsBlock) {
  std::mt19937 random(7);
  const SurfaceShape shape{72, 36, 1};
  std::vector<float> texels(shape.pixels() * 3);
  for (float& value : texels)
    value = random() % 40 == 0 ? 5000.0f : 0.4f + 0.3e-9f * static_cast<float>(random());
  for (const PixelFormat format : block_formats)
    for (const BlockQuality quality : {BlockQuality::fast, BlockQuality::normal}) {
      const PixelLayout layout = pixel_layout(format);
      const auto back = decode(format, encode(format, texels, shape, nullptr, 3, quality), shape);
      for (int by = 0; by < shape.height; by += layout.block_height)
        for (int bx = 0; bx < shape.width; bx += layout.block_width) {
          float given = 0, made = 0;
          for (int y = by; y < by + layout.block_height; ++y)
            for (int x = bx; x < bx + layout.block_width; ++x)
              for (int c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>((y * shape.width + x) * 3 + c);
                given = std::max(given, texels[i]);
                made = std::max(made, back[i]);
              }
          ASSERT_LE(made, 1.01f * given + 0x1p-14f) << name_of(format) << bx << ' ' << by;
        }
    }
}

TEST(BlockSurface, ValuesThatDoNotFitAreCounted) {
  const float infinity = std::numeric_limits<float>::infinity();
  const SurfaceShape shape{4, 4, 1};
  std::vector<float> texels(48, 65504.0f);
  texels[0] = 1e6f;
  texels[4] = infinity;
  for (const PixelFormat format : block_formats) {
    std::size_t clipped = 0;
    const std::vector<float> back = decode(format, encode(format, texels, shape, &clipped), shape);
    EXPECT_EQ(clipped, 2u) << name_of(format);
    for (const float value : back) EXPECT_NEAR(value, 65504, 655) << name_of(format);
  }
  texels.assign(48, -1.0f);
  for (const PixelFormat format : block_formats) {
    const bool has_sign = format == PixelFormat::bc6h_signed;
    std::size_t clipped = 0;
    const std::vector<float> back = decode(format, encode(format, texels, shape, &clipped), shape);
    EXPECT_EQ(clipped, has_sign ? 0u : 48u) << name_of(format);
    for (const float value : back) EXPECT_NEAR(value, has_sign ? -1 : 0, 0.01) << name_of(format);
  }
}

TEST(BlockSurface, SameBytesOnAnyNumberOfThreads) {
  const SurfaceShape shape{40, 40, 6};
  std::mt19937 random(5);
  std::vector<float> texels(shape.pixels() * 3);
  for (float& value : texels) value = test_value(random);
  for (const PixelFormat format : block_formats) {
    set_thread_count(1);
    const auto one = encode(format, texels, shape);
    set_thread_count(7);
    const auto seven = encode(format, texels, shape);
    set_thread_count(0);
    EXPECT_EQ(one, seven) << name_of(format);
  }
}

// The first byte of this block asks for a weight grid that is reserved; and a void extent (one colour) of NaN.
TEST(BlockSurface, InvalidAstcBlocksAreRefused) {
  const SurfaceShape shape{4, 4, 1};
  const auto refusal = [&](std::vector<std::uint8_t> block) {
    try {
      decode(PixelFormat::astc, block, shape);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_NE(refusal(std::vector<std::uint8_t>(16, 0)).find("memory: holds an ASTC block"), std::string::npos);
  std::vector<std::uint8_t> constant(16, 0xFF);
  constant[0] = 0xFC;
  EXPECT_NE(refusal(constant).find("memory: holds an ASTC block"), std::string::npos);
  for (std::size_t i = 8; i < 16; i += 2) constant[i] = 0, constant[i + 1] = 0x3C;  // 1.0
  EXPECT_EQ(refusal(constant), "taken");
}

}  // namespace
}  // namespace welkin
