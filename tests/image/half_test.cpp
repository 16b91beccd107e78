#include <welkin/image/half.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace welkin {
namespace {

// The value of a half by its definition, in double.
double half_value(std::uint16_t code) {
  const int exponent = (code >> 10) & 31;
  const int mantissa = code & 1023;
  const double sign = (code & 0x8000) != 0 ? -1 : 1;
  if (exponent == 0) return sign * std::ldexp(mantissa, -24);
  return sign * std::ldexp(1024 + mantissa, exponent - 25);
}

bool is_finite(std::uint16_t code) { return ((code >> 10) & 31) != 31; }

// Nearest even by search: the codes of positive halves are ordered like their values.
std::uint16_t nearest_by_search(double magnitude) {
  unsigned low = 0, high = 0x7bff;
  while (high - low > 1) {
    const unsigned middle = (low + high) / 2;
    (half_value(static_cast<std::uint16_t>(middle)) <= magnitude ? low : high) = middle;
  }
  const double below = magnitude - half_value(static_cast<std::uint16_t>(low));
  const double above = half_value(static_cast<std::uint16_t>(high)) - magnitude;
  if (below == above) return static_cast<std::uint16_t>(low % 2 == 0 ? low : high);
  return static_cast<std::uint16_t>(below < above ? low : high);
}

TEST(Half, EveryCodeComesBack) {
  for (unsigned i = 0; i < 0x10000; ++i) {
    const auto code = static_cast<std::uint16_t>(i);
    const float value = float_from_half(code);
    const bool nan = !is_finite(code) && (code & 1023) != 0;
    ASSERT_EQ(std::isnan(value), nan) << i;
    const std::uint16_t expected = nan ? static_cast<std::uint16_t>((code & 0x8000) | 0x7e00) : code;
    ASSERT_EQ(half_from_float(value), expected) << i;
  }
}

TEST(Half, DecodesByDefinition) {
  for (unsigned i = 0; i < 0x10000; ++i) {
    const auto code = static_cast<std::uint16_t>(i);
    const double expected = is_finite(code) ? half_value(code) : 0.0;
    const float value = float_from_half(code);
    ASSERT_EQ(std::isfinite(value) ? static_cast<double>(value) : 0.0, expected) << i;
    ASSERT_EQ(std::isfinite(value), is_finite(code)) << i;
  }
  EXPECT_EQ(float_from_half(0x7c00), std::numeric_limits<float>::infinity());
  EXPECT_EQ(float_from_half(0xfc00), -std::numeric_limits<float>::infinity());
}

TEST(Half, KnownCodes) {
  EXPECT_EQ(half_from_float(1.0f), 0x3c00);
  EXPECT_EQ(half_from_float(-2.0f), 0xc000);
  EXPECT_EQ(half_from_float(65504.0f), 0x7bff);
  EXPECT_EQ(half_from_float(65519.996f), 0x7bff);
  EXPECT_EQ(half_from_float(65520.0f), 0x7c00);
  EXPECT_EQ(half_from_float(0x1p-24f), 0x0001);
  EXPECT_EQ(half_from_float(0x1p-25f), 0x0000);  // tie to even
  EXPECT_EQ(half_from_float(0x1.000002p-25f), 0x0001);
  EXPECT_EQ(half_from_float(0x1.8p-24f), 0x0002);    // tie to even
  EXPECT_EQ(half_from_float(0x1.ffep-15f), 0x0400);  // the largest tie of the subnormals goes to 2^-14
  EXPECT_EQ(half_from_float(-0.0f), 0x8000);
}

// Between every two neighbours: just below the middle, the middle, just above.
TEST(Half, RoundsToNearestEvenAtEveryMiddle) {
  for (unsigned low = 0; low < 0x7bff; ++low) {
    const double a = half_value(static_cast<std::uint16_t>(low));
    const double b = half_value(static_cast<std::uint16_t>(low + 1));
    const auto middle = static_cast<float>((a + b) / 2);  // exact: one bit more than half has
    ASSERT_EQ(half_from_float(std::nextafter(middle, 0.0f)), low);
    ASSERT_EQ(half_from_float(middle), low % 2 == 0 ? low : low + 1);
    ASSERT_EQ(half_from_float(std::nextafter(middle, 1e9f)), low + 1);
  }
}

TEST(Half, RandomFloatsGoToTheNearestHalf) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint32_t> bits(0, std::bit_cast<std::uint32_t>(65519.0f));
  for (int i = 0; i < 300000; ++i) {
    const float value = std::bit_cast<float>(bits(random));
    const std::uint16_t expected = nearest_by_search(value);
    ASSERT_EQ(half_from_float(value), expected) << value;
    ASSERT_EQ(half_from_float(-value), expected | 0x8000) << value;
  }
}

TEST(Half, SaturatesAndCounts) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> values = {1.0f,      65504.0f,  65504.01f, 65520.0f,      1e30f, infinity,
                                     -infinity, -65504.0f, -1e9f,     std::nanf(""), -0.5f};
  const std::vector<std::uint16_t> expected = {0x3c00, 0x7bff, 0x7bff, 0x7bff, 0x7bff, 0x7bff,
                                               0xfbff, 0xfbff, 0xfbff, 0x0000, 0xb800};
  std::vector<std::uint16_t> codes(values.size());
  EXPECT_EQ(halves_from_floats(values, codes), 7u);
  EXPECT_EQ(codes, expected);
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(half_saturated(values[i], clipped), expected[i]);
  EXPECT_EQ(clipped, 7u);
}

TEST(Half, BulkEqualsOneByOne) {
  std::vector<float> values(100003);
  std::mt19937 random(11);
  for (float& value : values) value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
  std::vector<std::uint16_t> codes(values.size());
  std::size_t clipped = 0;
  const std::size_t bulk_clipped = halves_from_floats(values, codes);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(codes[i], half_saturated(values[i], clipped));
  EXPECT_EQ(bulk_clipped, clipped);
  EXPECT_GT(clipped, 0u);
  std::vector<float> back(codes.size());
  floats_from_halves(codes, back);
  for (std::size_t i = 0; i < codes.size(); ++i) ASSERT_EQ(back[i], float_from_half(codes[i]));
}

}  // namespace
}  // namespace welkin
