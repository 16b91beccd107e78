#include <welkin/sampling/sobol.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/oracles/chi_square.h"

namespace welkin {
namespace {

// Owen's scrambling digit by digit: each digit is flipped by a bit that depends on the digits above it and the seed. The
// hash is one such scrambling, so equal leading digits have to stay equal and the next must differ where it did.
TEST(Sobol, OwenScramblingKeepsCommonDigits) {
  for (std::uint32_t seed : {1u, 77u, 0xdeadbeefu})
    for (int digits = 0; digits < 31; ++digits)
      for (std::uint32_t base : {0u, 0x12345678u, 0xffffffffu}) {
        const std::uint32_t other = base ^ (1u << (31 - digits));  // the first `digits` digits alike
        const std::uint32_t a = owen_scrambled(base, seed), b = owen_scrambled(other, seed);
        int common = 0;
        while (common < 32 && ((a ^ b) >> (31 - common) & 1) == 0) ++common;
        ASSERT_EQ(common, digits);
      }
}

// The first dimension is the radical inverse, the second Pascal's triangle modulo 2: by plain loops.
TEST(Sobol, SecondDimensionIsPascalsMatrix) {
  for (std::uint32_t index : {1u, 2u, 3u, 1000u, 0x80000001u, 0xabcdef12u}) {
    std::uint32_t result = 0;
    for (int column = 0; column < 32; ++column)
      for (int row = 0; row <= column;
           ++row)  // binomial(column, row) is odd where row's bits are among column's
        if ((index >> column & 1) != 0 && (row & ~column) == 0) result ^= 1u << row;
    EXPECT_EQ(sobol_second_reversed(index), reversed_bits(reversed_bits(result))) << index;
  }
}

TEST(Sobol, EveryBlockOfAPowerOfTwoIsANet) {
  for (std::uint32_t seed : {3u, 99u})
    for (int power : {4, 8}) {
      const std::uint32_t count = 1u << power;
      for (std::uint32_t block : {0u, 5u})
        for (int across = 0; across <= power; ++across) {
          std::vector<int> seen(count);
          for (std::uint32_t i = 0; i < count; ++i) {
            SampleStream stream(block * count + i, seed);
            stream.next_1d();
            const Vec2f u = stream.next_2d();
            const auto x = static_cast<std::uint32_t>(std::ldexp(u.x, across));
            const auto y = static_cast<std::uint32_t>(std::ldexp(u.y, power - across));
            ++seen[(y << across) + x];
          }
          for (int each : seen) ASSERT_EQ(each, 1) << "2^" << across << " columns";
        }
    }
}

TEST(Sobol, SeedsAndDimensionsAreUniform) {
  std::vector<double> seen(256), expected(256, 100'000 / 256.0);
  for (std::uint32_t seed = 0; seed < 100'000; ++seed) {
    SampleStream stream(3, mix_bits32(seed));
    stream.next_2d();
    const Vec2f u = stream.next_2d();
    seen[16 * static_cast<std::size_t>(u.y * 16) + static_cast<std::size_t>(u.x * 16)] += 1;
  }
  EXPECT_GT(oracle::chi_square(seen, expected).p, 0.01);
}

double rms_error(std::uint32_t count) {
  double square = 0;
  for (std::uint32_t seed = 0; seed < 64; ++seed) {
    double sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      SampleStream stream(i, mix_bits32(seed));
      const Vec2f u = stream.next_2d();
      sum += std::sin(3.0 * u.x) * std::exp(double{u.y});
    }
    const double truth = (1 - std::cos(3.0)) / 3 * (std::exp(1.0) - 1);
    square += (sum / count - truth) * (sum / count - truth);
  }
  return std::sqrt(square / 64);
}

// Smooth integrands converge like n^-1.5 (Owen 1997): 16 times as many points, 64 times less error; plain random 4 times.
// One by one is the yardstick; more streams than are made together, at different dimensions.
TEST(Sobol, BatchesGiveTheSame) {
  std::vector<SampleStream> streams, alone;
  for (std::uint32_t i = 0; i < 21; ++i) {
    streams.emplace_back(7 * i, i * i);
    for (std::uint32_t k = 0; k < i % 3; ++k) streams.back().next_1d();
  }
  alone = streams;
  std::vector<SampleStream*> pointers;
  for (SampleStream& stream : streams) pointers.push_back(&stream);
  std::vector<Vec2f> numbers(streams.size());
  for (int call = 0; call < 3; ++call) {
    next_2d(pointers, numbers.data());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const Vec2f one = alone[i].next_2d();
      ASSERT_EQ(numbers[i].x, one.x);
      ASSERT_EQ(numbers[i].y, one.y);
    }
  }
}

TEST(Sobol, AveragesOfSmoothFunctionsConvergeFast) { EXPECT_GT(rms_error(64) / rms_error(1024), 30); }

}  // namespace
}  // namespace welkin
