#include <welkin/image/packed_formats.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

// B10G11R11_UFLOAT_PACK32 against its definition in the Vulkan specification: with E exponent and M mantissa of m bits,
// E = 0: M 2^(-14 - m); 0 < E < 31: (1 + M 2^-m) 2^(E - 15); E = 31: infinity, or NaN with M > 0.

namespace welkin {
namespace {

struct Channel {
  unsigned shift, mantissa;
  double max() const { return std::ldexp(2 - std::ldexp(1.0, -static_cast<int>(mantissa)), 15); }
};
constexpr std::array<Channel, 3> channels = {{{0, 6}, {11, 6}, {22, 5}}};

double defined_value(std::uint32_t code, unsigned mantissa) {
  const int m = static_cast<int>(mantissa), exponent = static_cast<int>(code >> mantissa);
  const double fraction = std::ldexp(code & ((1u << mantissa) - 1), -m);
  return exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, exponent - 15);
}

std::uint32_t code_of(float value, std::size_t c, std::size_t& clipped) {
  std::array<float, 3> rgb{};
  rgb[c] = value;
  const std::uint32_t word = r11g11b10f_from_floats(rgb.data(), clipped);
  EXPECT_EQ(word & ~(((1u << (channels[c].mantissa + 5)) - 1) << channels[c].shift), 0u) << "other channels";
  return word >> channels[c].shift;
}

std::uint32_t code_of(float value, std::size_t c) {
  std::size_t clipped = 0;
  const std::uint32_t code = code_of(value, c, clipped);
  EXPECT_EQ(clipped, 0u) << value;
  return code;
}

TEST(R11g11b10f, DecodesEveryCodeByDefinition) {
  for (std::size_t c = 0; c < 3; ++c) {
    const unsigned m = channels[c].mantissa;
    const auto decoded = [&](std::uint32_t code) {
      std::array<float, 3> rgb{};
      floats_from_r11g11b10f(code << channels[c].shift, rgb.data());
      return rgb[c];
    };
    for (std::uint32_t code = 0; code < (31u << m); ++code)
      ASSERT_EQ(static_cast<double>(decoded(code)), defined_value(code, m)) << code;
    EXPECT_EQ(decoded(31u << m), std::numeric_limits<float>::infinity());
    for (std::uint32_t code = (31u << m) + 1; code < (32u << m); ++code)
      EXPECT_TRUE(std::isnan(decoded(code))) << code;
  }
}

// Every finite code is its own nearest; half way to the next one the even code wins, and the floats beside the middle
// go to either side. That fixes the rounding of every float, since it is monotonic.
TEST(R11g11b10f, RoundsToNearestEvenAtEveryCode) {
  for (std::size_t c = 0; c < 3; ++c) {
    const unsigned m = channels[c].mantissa;
    for (std::uint32_t code = 0; code + 1 < (31u << m); ++code) {
      const auto value = static_cast<float>(defined_value(code, m));
      const auto middle = static_cast<float>((defined_value(code, m) + defined_value(code + 1, m)) / 2);
      ASSERT_EQ(code_of(value, c), code);
      ASSERT_EQ(code_of(middle, c), code + code % 2) << code;
      ASSERT_EQ(code_of(std::nextafter(middle, 0.0f), c), code);
      ASSERT_EQ(code_of(std::nextafter(middle, 1e9f), c), code + 1);
    }
    EXPECT_EQ(code_of(static_cast<float>(channels[c].max()), c), (31u << m) - 1);
  }
}

TEST(R11g11b10f, SaturatesAndCounts) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint32_t most = (31u << channels[c].mantissa) - 1;
    const auto max = static_cast<float>(channels[c].max());
    std::size_t clipped = 0;
    for (const float value : {std::nextafter(max, infinity), 65536.0f, 1e30f, infinity})
      EXPECT_EQ(code_of(value, c, clipped), most) << value;
    for (const float value : {-1.0f, -1e-30f, -infinity, std::nanf("")})
      EXPECT_EQ(code_of(value, c, clipped), 0u) << value;
    EXPECT_EQ(clipped, 8u);
    EXPECT_EQ(code_of(-0.0f, c), 0u);
    EXPECT_EQ(code_of(1e-30f, c), 0u);
  }
  EXPECT_EQ(channels[0].max(), static_cast<double>(r11g11b10f_max_rg));
  EXPECT_EQ(channels[2].max(), static_cast<double>(r11g11b10f_max_b));
}

TEST(PixelFormats, NamesComeBack) {
  for (const char* name :
       {"rgba16f", "rgba32f", "rgb9e5", "r11g11b10f", "bc6h", "bc6h_signed", "astc", "astc6x6"})
    EXPECT_EQ(pixel_format_name(colour_format_from_name(name).value()), name);
  for (const char* name : {"rg16f", "rg32f", "", "BC6H"}) EXPECT_FALSE(colour_format_from_name(name)) << name;
}

TEST(PixelFormats, BlocksCountWhole) {
  const PixelLayout four = pixel_layout(PixelFormat::astc), six = pixel_layout(PixelFormat::astc6x6);
  EXPECT_EQ(four.image_bytes(1, 1), 16u);
  EXPECT_EQ(four.image_bytes(4, 4), 16u);
  EXPECT_EQ(four.image_bytes(5, 4), 32u);
  EXPECT_EQ(four.image_bytes(5, 9), 96u);
  EXPECT_EQ(six.image_bytes(6, 7), 32u);
  EXPECT_EQ(pixel_layout(PixelFormat::r11g11b10f).image_bytes(3, 5), 60u);
  EXPECT_EQ(pixel_layout(PixelFormat::rgba16f).image_bytes(3, 5), 120u);
}

}  // namespace
}  // namespace welkin
