#include <welkin/image/codecs/bc6h/bc6h.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <welkin/image/half.h>
#include <welkin/parallel/parallel_for.h>

#include "bc6h_reference.h"

namespace welkin {
namespace {

using Texels = std::array<float, 48>;
using Halves = std::array<std::uint16_t, 48>;

constexpr std::array<Bc6hSpeed, 3> speeds = {Bc6hSpeed::fast, Bc6hSpeed::normal, Bc6hSpeed::high};

Halves decode(const Bc6hBlock& block, bool is_signed) {
  Halves halves{};
  decode_bc6h_block(block, is_signed, halves.data());
  return halves;
}

Halves through(const Texels& rgb, const Bc6hOptions& options) {
  std::size_t clipped = 0;
  return decode(encode_bc6h_block(rgb.data(), options, clipped), options.is_signed);
}

double log_level(double x) { return x < 0 ? -std::log1p(-x) : std::log1p(x); }

double squared_error(const Texels& rgb, const Halves& halves) {
  double sum = 0;
  for (std::size_t i = 0; i < 48; ++i) {
    const double d = log_level(rgb[i]) - log_level(float_from_half(halves[i]));
    sum += d * d;
  }
  return sum;
}

TEST(Bc6hDecode, ABlockByHand) {
  // Mode 3 (bits 00011), both ends 10 bits a channel: red 0 to 1023, green 512 twice, blue 1 twice; all indices 0 but
  // texel 1, whose four bits from bit 68 on are 15: the second end.
  Bc6hBlock block{};
  const auto put = [&](int at, int count, int value) {
    for (int i = 0; i < count; ++i) {
      block.at((at + i) / 8) =
          static_cast<std::uint8_t>(block.at((at + i) / 8) | (((value >> i) & 1) << ((at + i) % 8)));
    }
  };
  put(0, 5, 3), put(15, 10, 512), put(25, 10, 1), put(35, 10, 1023), put(45, 10, 512), put(55, 10, 1),
      put(68, 4, 15);
  const Halves halves = decode(block, false);
  EXPECT_EQ(halves[0], 0);
  EXPECT_EQ(halves[1], (((512 << 15) + 0x4000) >> 9) * 31 >> 6);
  EXPECT_EQ(halves[2], (((1 << 15) + 0x4000) >> 9) * 31 >> 6);
  EXPECT_EQ(halves[3], 0x7bff);  // 65504
  EXPECT_EQ(halves[6], 0);
}

TEST(Bc6hDecode, EveryModeAsTheSpecificationsBitTables) {
  std::mt19937 random(1);
  for (const ReferenceMode& mode : reference_modes) {
    for (int i = 0; i < 400; ++i) {
      Bc6hBlock block{};
      for (auto& byte : block) byte = static_cast<std::uint8_t>(random());
      const int mask = mode.number < 2 ? 3 : 31;
      block[0] = static_cast<std::uint8_t>((block[0] & ~mask) | mode.number);
      for (bool is_signed : {false, true}) {
        ASSERT_EQ(decode(block, is_signed), reference_decode(block, is_signed)) << "mode " << mode.number;
      }
    }
  }
}

TEST(Bc6hDecode, ReservedModesAreBlack) {
  for (int mode : {19, 23, 27, 31}) {
    Bc6hBlock block{};
    block.fill(0xff);
    block[0] = static_cast<std::uint8_t>(0xe0 | mode);
    for (bool is_signed : {false, true}) EXPECT_EQ(decode(block, is_signed), Halves{});
  }
}

// One-subset mode 15 has 16 bits an end and reaches every half: a constant block is exact.
TEST(Bc6hEncode, ConstantBlocksAreExact) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    for (const Bc6hSpeed speed : speeds) {
      Texels rgb{};
      Halves expected{};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto code = static_cast<std::uint16_t>(random() % 0x7c00);
        const bool negative = random() % 2 == 0 && code > 0;
        for (std::size_t t = 0; t < 16; ++t) {
          expected[3 * t + c] = static_cast<std::uint16_t>(code | (negative ? 0x8000 : 0));
          rgb[3 * t + c] = float_from_half(expected[3 * t + c]);
        }
      }
      ASSERT_EQ(through(rgb, {.is_signed = true, .speed = speed}), expected);
      for (auto& code : expected) code &= 0x7fff;
      for (auto& value : rgb) value = std::abs(value);
      ASSERT_EQ(through(rgb, {.is_signed = false, .speed = speed}), expected);
    }
  }
}

// Blocks of many kinds: smooth, noise, single fireflies, edges, wild dynamic range, almost constant.
Texels random_block(std::mt19937& random, bool is_signed) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> normal;
  const int kind = static_cast<int>(random() % 7);
  const float exposure = std::exp2(16 * unit(random) - 10);
  const int split = static_cast<int>(random() % 15) + 1;
  float base[2][3], slope[2][3];
  for (auto& row : base)
    for (float& b : row) b = exposure * std::exp(normal(random));
  for (auto& row : slope)
    for (float& s : row) s = 0.1f * exposure * normal(random);
  Texels rgb{};
  for (std::size_t t = 0; t < 16; ++t) {
    const int side = (kind == 1 || kind == 4) && static_cast<int>(t % 4 * 3 + t / 4 * 2) > split ? 1 : 0;
    for (std::size_t c = 0; c < 3; ++c) {
      float v = base[side][c] + slope[side][c] * static_cast<float>(t % 4) +
                slope[1 - side][c] * static_cast<float>(t / 4);
      if (kind == 2) v = exposure * std::exp(4 * normal(random));
      if (kind == 3) v = t == static_cast<std::size_t>(split) ? 60000 * unit(random) : v;
      if (kind == 5) v = base[0][c] * (1 + 0.001f * normal(random));
      if (kind == 6) v = random() % 2 == 0 ? 0 : 65504;
      rgb[3 * t + c] = is_signed ? v * (random() % 4 == 0 ? -1.0f : 1.0f) : std::max(v, 0.0f);
    }
  }
  return rgb;
}

int half_magnitude(float value) {
  std::size_t clipped = 0;
  return half_saturated(value, clipped) & 0x7fff;
}

TEST(Bc6hEncode, NeverBrighterThanTheBlock) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const bool is_signed = i % 2 == 1;
    const Texels rgb = random_block(random, is_signed);
    for (const Bc6hSpeed speed : speeds) {
      const Halves halves = through(rgb, {.is_signed = is_signed, .speed = speed});
      for (std::size_t c = 0; c < 3; ++c) {
        int most = 0, got = 0;
        for (std::size_t k = c; k < 48; k += 3) {
          most = std::max(most, half_magnitude(rgb[k]));
          got = std::max(got, halves[k] & 0x7fff);
        }
        ASSERT_LE(got, most) << "block " << i << " speed " << static_cast<int>(speed) << " channel " << c;
      }
    }
  }
}

// Each step may lose on a block (searches are greedy), not on the whole.
TEST(Bc6hEncode, SlowerIsBetterInTotal) {
  for (bool is_signed : {false, true}) {
    std::mt19937 random(4);
    std::array<double, 3> total{};
    for (int i = 0; i < 700; ++i) {
      const Texels rgb = random_block(random, is_signed);
      for (std::size_t s = 0; s < 3; ++s) {
        total[s] += squared_error(rgb, through(rgb, {.is_signed = is_signed, .speed = speeds[s]}));
      }
    }
    EXPECT_LT(total[1], total[0]);
    EXPECT_LT(total[2], total[1]);
    EXPECT_GT(total[2], 0);
  }
}

// Two lines at right angles, split as each partition says: one line cannot hold both.
// A lamp of a few texels with a soft rim among dim ones: counted by their difference, lamps keep more of their energy.
TEST(Bc6hEncode, LinearAboveKeepsTheEnergyOfLamps) {
  std::mt19937 random(11);
  double lost[2] = {}, energy = 0;
  for (int trial = 0; trial < 60; ++trial) {
    float rgb[48];
    const float lamp = 2000 + static_cast<float>(random() % 20000);
    for (int t = 0; t < 16; ++t) {
      const float share = std::exp(-0.5f * static_cast<float>(random() % 16));
      for (int c = 0; c < 3; ++c) rgb[3 * t + c] = 1 + share * lamp * (1 - 0.1f * static_cast<float>(c));
    }
    for (int i = 0; i < 2; ++i) {
      std::size_t clipped = 0;
      std::uint16_t halves[48];
      decode_bc6h_block(encode_bc6h_block(rgb, {.linear_above = 16.0 * i}, clipped), false, halves);
      for (int k = 0; k < 48; ++k) {
        const double d = float_from_half(halves[k]) - rgb[k];
        lost[i] += d * d;
      }
    }
    for (const float value : rgb) energy += static_cast<double>(value) * value;
  }
  EXPECT_LT(lost[1], 0.5 * lost[0]);  // seen: see the message
  EXPECT_LT(std::sqrt(lost[1] / energy), 0.05) << std::sqrt(lost[0] / energy);
}

TEST(Bc6hEncode, FindsEveryPartition) {
  for (int p = 0; p < 32; ++p) {
    std::string picture;
    for (const char* at = reference_partitions.at(p); *at != 0; ++at)
      picture += *at == ' ' ? "" : std::string(1, *at);
    Texels rgb{};
    for (std::size_t t = 0; t < 16; ++t) {
      const float along = 0.5f + 0.1f * static_cast<float>(t * 7 % 16);
      const bool second = picture[t] == '1';
      rgb[3 * t] = second ? 0.5f : along;
      rgb[3 * t + 1] = second ? along : 2.0f;
      rgb[3 * t + 2] = 1.0f;
    }
    for (const Bc6hSpeed speed : speeds) {
      std::size_t clipped = 0;
      const Bc6hBlock block = encode_bc6h_block(rgb.data(), {.speed = speed}, clipped);
      EXPECT_NE(block[0] & 3, 3) << p;  // two subsets
      EXPECT_EQ(reference_bits(block, 77, 5), p) << static_cast<int>(speed);
    }
  }
}

// The encoder considers all 14 modes: blocks made from each mode's own range of ends get that mode back somewhere.
TEST(Bc6hEncode, HighUsesAllModes) {
  std::mt19937 random(5);
  std::set<int> used;
  for (int i = 0; i < 3000 && used.size() < 14; ++i) {
    Bc6hBlock block{};
    for (auto& byte : block) byte = static_cast<std::uint8_t>(random());
    const ReferenceMode& mode = reference_modes.at(i % 14);
    block[0] = static_cast<std::uint8_t>((block[0] & (mode.number < 2 ? ~3 : ~31)) | mode.number);
    const Halves halves = decode(block, false);
    Texels rgb{};
    for (std::size_t k = 0; k < 48; ++k) rgb[k] = float_from_half(halves[k]);
    std::size_t clipped = 0;
    const Bc6hBlock again = encode_bc6h_block(rgb.data(), {.speed = Bc6hSpeed::high}, clipped);
    used.insert((again[0] & 3) < 2 ? again[0] & 3 : again[0] & 31);
  }
  EXPECT_EQ(used.size(), 14u);
}

TEST(Bc6hEncode, SaturatesAndCounts) {
  const float infinity = std::numeric_limits<float>::infinity();
  Texels rgb{};
  for (std::size_t t = 0; t < 16; ++t)
    rgb[3 * t] = infinity, rgb[3 * t + 1] = std::nanf(""), rgb[3 * t + 2] = -2;
  std::size_t clipped = 0;
  const Halves unsigned_halves = decode(encode_bc6h_block(rgb.data(), {}, clipped), false);
  EXPECT_EQ(clipped, 48u);
  clipped = 0;
  const Halves signed_halves = decode(encode_bc6h_block(rgb.data(), {.is_signed = true}, clipped), true);
  EXPECT_EQ(clipped, 32u);
  for (std::size_t t = 0; t < 16; ++t) {
    EXPECT_EQ(unsigned_halves[3 * t], 0x7bff);
    EXPECT_EQ(unsigned_halves[3 * t + 1], 0);
    EXPECT_EQ(unsigned_halves[3 * t + 2], 0);
    EXPECT_EQ(signed_halves[3 * t], 0x7bff);
    EXPECT_EQ(signed_halves[3 * t + 1], 0);
    EXPECT_EQ(signed_halves[3 * t + 2], 0xc000);
  }
}

std::vector<float> ramp_image(int width, int height, int channels) {
  std::vector<float> pixels(static_cast<std::size_t>(width) * height * channels);
  std::mt19937 random(6);
  std::uniform_real_distribution<float> unit(0.5f, 1.5f);
  for (float& p : pixels) p = unit(random);
  return pixels;
}

TEST(Bc6hImage, SizesThatAreNotMultiplesOfFour) {
  EXPECT_EQ(bc6h_bytes(1, 1), 16u);
  EXPECT_EQ(bc6h_bytes(5, 9), 16u * 2 * 3);
  const int width = 6, height = 5;
  std::vector<float> pixels(static_cast<std::size_t>(width) * height * 3);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<float>(i % 3 + 1);       // 1 2 3: constant
  pixels[0] = 1e6f, pixels[pixels.size() - 1] = -1;  // clipped, once each
  std::vector<std::uint8_t> blocks(bc6h_bytes(width, height));
  EXPECT_EQ(encode_bc6h(pixels, width, height, 3, 1, {.speed = Bc6hSpeed::fast}, blocks), 2u);
  std::vector<float> back(pixels.size());
  decode_bc6h(blocks, width, height, false, 1, back);
  for (int y = 0; y < 4; ++y) {
    for (int x = 4; x < 6; ++x) {  // the block of columns 4 and 5 is constant, padding included
      for (int c = 0; c < 3; ++c) EXPECT_EQ(back[(y * width + x) * 3 + c], static_cast<float>(c + 1));
    }
  }
}

TEST(Bc6hImage, FourthChannelIsDroppedAndFactorIsExact) {
  const std::vector<float> rgb = ramp_image(8, 8, 3);
  std::vector<float> rgba;
  for (std::size_t i = 0; i < rgb.size(); i += 3) {
    rgba.insert(rgba.end(), {4 * rgb[i], 4 * rgb[i + 1], 4 * rgb[i + 2], -9.0f});
  }
  std::vector<std::uint8_t> a(bc6h_bytes(8, 8)), b(a.size());
  EXPECT_EQ(encode_bc6h(rgb, 8, 8, 3, 1, {}, a), 0u);
  EXPECT_EQ(encode_bc6h(rgba, 8, 8, 4, 0.25f, {}, b), 0u);
  EXPECT_EQ(a, b);
  std::vector<float> back(rgb.size()), back4(rgb.size());
  decode_bc6h(a, 8, 8, false, 1, back);
  decode_bc6h(b, 8, 8, false, 4, back4);
  for (std::size_t i = 0; i < rgb.size(); ++i) EXPECT_EQ(back4[i], 4 * back[i]);
}

TEST(Bc6hImage, SameBytesOnAnyNumberOfThreads) {
  const std::vector<float> pixels = ramp_image(64, 64, 3);
  std::vector<std::uint8_t> one(bc6h_bytes(64, 64)), many(one.size());
  set_thread_count(1);
  encode_bc6h(pixels, 64, 64, 3, 1, {}, one);
  set_thread_count(0);
  encode_bc6h(pixels, 64, 64, 3, 1, {}, many);
  EXPECT_EQ(one, many);
}

}  // namespace
}  // namespace welkin
