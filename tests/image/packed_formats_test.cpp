#include <welkin/image/packed_formats.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <welkin/image/half.h>

namespace welkin {
namespace {

std::uint32_t encode(float r, float g, float b) {
  const std::array<float, 3> rgb = {r, g, b};
  std::size_t clipped = 0;
  const std::uint32_t word = rgb9e5_from_floats(rgb.data(), clipped);
  EXPECT_EQ(clipped, 0u);
  return word;
}

// The exact value of a channel, by the definition in EXT_texture_shared_exponent: m 2^(E - 15 - 9).
double channel_value(std::uint32_t word, unsigned channel) {
  return std::ldexp((word >> (9 * channel)) & 511u, static_cast<int>(word >> 27) - 24);
}

// The smallest error that a channel can have with the given exponent: over all 512 mantissas.
double best_error(double value, int exponent) {
  double best = std::numeric_limits<double>::infinity();
  for (int mantissa = 0; mantissa < 512; ++mantissa) {
    best = std::min(best, std::abs(std::ldexp(mantissa, exponent - 24) - value));
  }
  return best;
}

TEST(Rgb9e5, KnownWords) {
  EXPECT_EQ(encode(0, 0, 0), 0u);
  EXPECT_EQ(encode(1, 1, 1), (16u << 27) | (256u << 18) | (256u << 9) | 256u);
  EXPECT_EQ(encode(65408, 0, 0), (31u << 27) | 511u);
  EXPECT_EQ(encode(0, 0x1p-24f, 0), 1u << 9);
  EXPECT_EQ(encode(511.5f, 1, 0), (24u << 27) | (1u << 9) | 511u);   // as close as 512, and finer
  EXPECT_EQ(encode(511.75f, 2, 0), (25u << 27) | (1u << 9) | 256u);  // the carry into the exponent
  EXPECT_EQ(encode(-0.0f, -0.0f, -0.0f), 0u);
  EXPECT_EQ(encode(0x1p-149f, 0, 0), 0u);
  EXPECT_EQ(encode(-0.0f, 0, 2), (17u << 27) | (256u << 18));
}

TEST(Rgb9e5, DecodesEveryFieldByDefinition) {
  for (std::uint32_t exponent = 0; exponent < 32; ++exponent) {
    for (std::uint32_t mantissa = 0; mantissa < 512; ++mantissa) {
      const std::uint32_t word =
          (exponent << 27) | ((511 - mantissa) << 18) | (mantissa << 9) | (mantissa ^ 85u);
      std::array<float, 3> rgb{};
      floats_from_rgb9e5(word, rgb.data());
      for (unsigned c = 0; c < 3; ++c) ASSERT_EQ(static_cast<double>(rgb[c]), channel_value(word, c));
    }
  }
}

// Exhaustive over the whole code space, one exponent after another: no word has a smaller error in the
// largest channel; among the words that tie there, none (with any exponent) is closer in another channel.
TEST(Rgb9e5, NoOtherCodeIsCloser) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> log2_value(-28.0f, 15.99f), ratio(0.0f, 1.0f);
  for (int i = 0; i < 1000; ++i) {
    const float largest = std::min(std::exp2(log2_value(random)), rgb9e5_max);
    const std::array<float, 3> rgb = {largest * ratio(random), largest, largest * ratio(random) * 0.01f};
    const std::uint32_t word = encode(rgb[0], rgb[1], rgb[2]);
    const double error_of_largest = std::abs(channel_value(word, 1) - rgb[1]);
    for (int exponent = 0; exponent < 32; ++exponent) {
      const double best = best_error(rgb[1], exponent);
      ASSERT_GE(best, error_of_largest) << rgb[1] << " exponent " << exponent;
      const double tie = best == error_of_largest ? 1 : 0;  // only words that tie may compete below
      for (unsigned c : {0u, 2u}) {
        ASSERT_GE(best_error(rgb[c], exponent), tie * std::abs(channel_value(word, c) - rgb[c])) << rgb[c];
      }
    }
  }
}

// Around every carry: the middle between 511 and 512 units, for every exponent.
TEST(Rgb9e5, CarriesAtEveryExponent) {
  for (int exponent = 0; exponent < 31; ++exponent) {
    const float tie = std::ldexp(511.5f, exponent - 24);
    EXPECT_EQ(encode(tie, 0, 0), (static_cast<unsigned>(exponent) << 27) | 511u);
    EXPECT_EQ(encode(std::nextafter(tie, 1e9f), 0, 0), (static_cast<unsigned>(exponent + 1) << 27) | 256u);
    EXPECT_EQ(encode(std::nextafter(tie, 0.0f), 0, 0), (static_cast<unsigned>(exponent) << 27) | 511u);
  }
}

TEST(Rgb9e5, SaturatesAndCounts) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::array<float, 3> wild = {infinity, -1.0f, std::nanf("")};
  std::size_t clipped = 0;
  EXPECT_EQ(rgb9e5_from_floats(wild.data(), clipped), (31u << 27) | 511u);
  EXPECT_EQ(clipped, 3u);
  const std::array<float, 3> bright = {65409.0f, 65408.0f, 1e30f};
  EXPECT_EQ(rgb9e5_from_floats(bright.data(), clipped), (31u << 27) | (511u << 18) | (511u << 9) | 511u);
  EXPECT_EQ(clipped, 5u);
}

TEST(PixelFormats, Facts) {
  EXPECT_EQ(pixel_format_name(PixelFormat::rgba16f), "rgba16f");
  EXPECT_EQ(pixel_format_name(PixelFormat::rg32f), "rg32f");
  EXPECT_EQ(pixel_format_max(PixelFormat::rg16f), 65504.0f);
  EXPECT_EQ(pixel_format_max(PixelFormat::rgb9e5), 65408.0f);
  EXPECT_EQ(pixel_format_max(PixelFormat::rgba32f), std::numeric_limits<float>::max());
  EXPECT_FALSE(pixel_format_has_sign(PixelFormat::rgb9e5));
  EXPECT_EQ(pixel_layout(PixelFormat::rgba16f).bytes(), 8u);
  EXPECT_EQ(pixel_layout(PixelFormat::rgba32f).bytes(), 16u);
  EXPECT_EQ(pixel_layout(PixelFormat::rgb9e5).bytes(), 4u);
  EXPECT_EQ(pixel_layout(PixelFormat::rg16f).bytes(), 4u);
  EXPECT_EQ(pixel_layout(PixelFormat::rg32f).bytes(), 8u);
}

std::vector<float> through(PixelFormat format, const std::vector<float>& pixels, int channels, float factor,
                           std::size_t& clipped) {
  const std::size_t count = pixels.size() / static_cast<std::size_t>(channels);
  std::vector<std::uint8_t> bytes(count * pixel_layout(format).bytes());
  clipped = encode_pixels(pixels, channels, factor, format, bytes);
  std::vector<float> back(3 * count);
  decode_pixels(bytes, pixel_layout(format), 1 / factor, back);
  return back;
}

TEST(PixelFormats, ChannelsAndFactor) {
  std::size_t clipped = 0;
  const std::vector<float> rgb = {1, 2, 3, 0.5f, 0.25f, 1};
  EXPECT_EQ(through(PixelFormat::rgba32f, rgb, 3, 1, clipped), rgb);
  EXPECT_EQ(through(PixelFormat::rgba16f, rgb, 3, 0.25f, clipped), rgb);
  EXPECT_EQ(through(PixelFormat::rgb9e5, rgb, 3, 0.25f, clipped), rgb);
  EXPECT_EQ(through(PixelFormat::rg16f, rgb, 3, 1, clipped), (std::vector<float>{1, 2, 0, 0.5f, 0.25f, 0}));
  EXPECT_EQ(through(PixelFormat::rg32f, rgb, 2, 1, clipped),
            (std::vector<float>{1, 2, 0, 3, 0.5f, 0, 0.25f, 1, 0}));
  EXPECT_EQ(through(PixelFormat::rgba16f, {7, 8}, 1, 1, clipped), (std::vector<float>{7, 7, 7, 8, 8, 8}));
  EXPECT_EQ(through(PixelFormat::rgba32f, {1, 2, 3, 9}, 4, 1, clipped), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(clipped, 0u);
}

TEST(PixelFormats, AlphaIsOne) {
  const std::vector<float> rgba = {1, 2, 3, 0.125f};
  std::array<std::uint8_t, 8> bytes{};
  encode_pixels(rgba, 4, 0.5f, PixelFormat::rgba16f, bytes);
  const std::array<std::uint8_t, 8> expected = {0x00, 0x38, 0x00, 0x3c,
                                                0x00, 0x3e, 0x00, 0x3c};  // 0.5 1 1.5 1
  EXPECT_EQ(bytes, expected);
}

TEST(PixelFormats, FloatsKeepTheirBitsAndLoseOnlyNanAndInfinity) {
  const float infinity = std::numeric_limits<float>::infinity(), most = std::numeric_limits<float>::max();
  std::size_t clipped = 0;
  EXPECT_EQ(
      through(PixelFormat::rgba32f, {1e-40f, -3, 1e38f, std::nanf(""), infinity, -infinity}, 3, 1, clipped),
      (std::vector<float>{1e-40f, -3, 1e38f, 0, most, -most}));
  EXPECT_EQ(clipped, 3u);
}

// More pixels than one parallel chunk: positions and counts stay right across chunks.
TEST(PixelFormats, ManyPixels) {
  std::vector<float> pixels(3 * 100000);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<float>(i % 2048);
  for (std::size_t i = 0; i < pixels.size(); i += 1000) pixels[i] = 1e6f;
  std::size_t clipped = 0;
  const std::vector<float> back = through(PixelFormat::rgba16f, pixels, 3, 1, clipped);
  EXPECT_EQ(clipped, 300u);
  for (std::size_t i = 0; i < pixels.size(); ++i) ASSERT_EQ(back[i], std::min(pixels[i], half_max)) << i;
}

}  // namespace
}  // namespace welkin
