#include <welkin/image/codecs/bc6h/kernels.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include <welkin/image/codecs/bc6h/error_scale.h>
#include <welkin/image/codecs/bc6h/quantise.h>

// The vectorised parts of the encoder against plain loops over the specification's formulas.

namespace welkin::bc6h {
namespace {

Targets random_targets(std::mt19937& random, bool is_signed) {
  int halves[48];
  float importance[16];
  const int base = static_cast<int>(random() % 0x7000), spread = 1 << (random() % 13);
  for (int& h : halves) {
    h = std::min(base + static_cast<int>(random() % static_cast<unsigned>(spread)), 0x7bff);
    h = is_signed && random() % 2 == 0 ? -h : h;
  }
  for (float& i : importance) i = static_cast<float>(random() % 3 + 1);
  return make_targets(halves, importance, is_signed, error_scale()->values());
}

Ends random_ends(std::mt19937& random, const Targets& targets) {
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto near = [&] {
      const float p = targets.position[c][static_cast<int>(random() % 16)];
      return static_cast<int>(p) + static_cast<int>(random() % 101) - 50;
    };
    const int most = targets.is_signed ? 0x7fff : 0xffff;
    ends.first[c] = std::clamp(near(), targets.is_signed ? -most : 0, most);
    ends.second[c] = std::clamp(near(), targets.is_signed ? -most : 0, most);
  }
  return ends;
}

// Distance of texel t to palette entry of the weight, `forbidden` or more when it is brighter than allowed.
double distance(const Targets& targets, const Ends& ends, int weight, int t) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const int half = half_of_position(interpolate(ends.first[c], ends.second[c], weight), targets.is_signed);
    const double d =
        static_cast<double>(error_scale()->values()[half]) - static_cast<double>(targets.level[c][t]);
    sum += std::abs(half) > targets.limit[c] ? static_cast<double>(forbidden) : d * d;
  }
  return sum;
}

TEST(Bc6hKernels, AssignTakesTheNearestEntryThatIsNotBrighter) {
  std::mt19937 random(1);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool is_signed = i % 2 == 1;
    const Targets targets = random_targets(random, is_signed);
    const Ends ends = random_ends(random, targets);
    const int levels = i % 3 == 0 ? 16 : 8;
    const Lanes& member = levels == 16 ? all_members() : member_of(i % 32, i / 32 % 2);
    IntLanes indices;
    const double cost = assign(targets, member, ends, levels, indices);
    const double finite = 0.9 * static_cast<double>(forbidden);  // beyond that only "too much" is meant
    double expected = 0;
    for (int t = 0; t < 16; ++t) {
      double best = 1e30;
      for (int k = 0; k < levels; ++k) {
        best = std::min(best, distance(targets, ends, levels == 8 ? weights3[k] : weights4[k], t));
      }
      refused += best >= static_cast<double>(forbidden) ? 1 : 0;
      const double chosen =
          distance(targets, ends, levels == 8 ? weights3[indices[t]] : weights4[indices[t]], t);
      // Floats of levels up to 11 with 24 bits: differences are off by 1e-6, squares by 1e-6 of their root and 1e-12.
      ASSERT_LE(std::min(chosen, finite), best + 4e-6 * std::sqrt(best) + 4e-12) << i << " texel " << t;
      expected += static_cast<double>(member[t]) * static_cast<double>(targets.importance[t]) * best;
    }
    ASSERT_NEAR(std::min(cost, finite), std::min(expected, finite), 1e-4 * std::min(expected, finite) + 1e-8)
        << i;
  }
  EXPECT_GT(refused, 0);  // the forbidden case was among them
}

TEST(Bc6hKernels, ChannelCostIsWhatAssignedTexelsCost) {
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    const Targets targets = random_targets(random, i % 2 == 1);
    const Ends ends = random_ends(random, targets);
    IntLanes indices;
    assign(targets, all_members(), ends, 16, indices);
    for (std::size_t c = 0; c < 3; ++c) {
      const IndexStatistics statistics = index_statistics(targets.level[c], targets.importance, indices);
      const int first[2] = {ends.first[c], ends.first[c] / 2},
                second[2] = {ends.second[c], ends.second[c] / 2};
      double cost[2] = {}, direct[2] = {};
      for (int k = 0; k < 2; ++k) {
        cost[k] = channel_cost(targets.scale, statistics, first[k], second[k], 16, 0x7bff, targets.is_signed);
        for (int t = 0; t < 16; ++t) {
          const int half =
              half_of_position(interpolate(first[k], second[k], weights4[indices[t]]), targets.is_signed);
          const double d =
              static_cast<double>(error_scale()->values()[half]) - static_cast<double>(targets.level[c][t]);
          direct[k] += static_cast<double>(targets.importance[t]) * d * d;
        }
      }
      // The same up to a constant; floats of squares of levels up to 11.
      ASSERT_NEAR(cost[1] - cost[0], direct[1] - direct[0], 1e-4 * (direct[0] + direct[1]) + 1e-6);
    }
  }
}

TEST(Bc6hKernels, QuantiseTakesTheNearestCode) {
  std::mt19937 random(3);
  for (int bits : {6, 7, 8, 9, 10, 11, 12, 16}) {
    for (bool is_signed : {false, true}) {
      const int end = is_signed ? 0x7fff : 0xffff, last = (1 << (is_signed ? bits - 1 : bits)) - 1;
      for (int i = 0; i < 40; ++i) {
        const int ends[] = {i, end - i * (1 << (16 - bits)) / 8,
                            static_cast<int>(random() % static_cast<unsigned>(end))};
        for (const int position : ends) {
          const int most = i % 4 == 0 ? last / 2 : last;
          const int code = quantise(static_cast<float>(position), bits, most, is_signed);
          ASSERT_LE(code, most);
          const int miss = std::abs(unquantise(code, bits, is_signed) - position);
          for (int other : {code - 1, code + 1}) {
            const int clamped = std::clamp(other, 0, most);
            ASSERT_LE(miss, std::abs(unquantise(clamped, bits, is_signed) - position))
                << bits << " " << position;
          }
        }
      }
      for (int limit : {0, 1, 2, 31, 1000, 15360, 31742, 31743}) {
        const int code = largest_code(limit, bits, is_signed);
        ASSERT_LE(half_of_position(unquantise(code, bits, is_signed), is_signed), limit);
        const int next = std::min(code + 1, last);
        ASSERT_TRUE(code == last || half_of_position(unquantise(next, bits, is_signed), is_signed) > limit)
            << bits;
      }
    }
  }
}

TEST(Bc6hKernels, PartitionOfTwoLinesIsRankedFirst) {
  for (int p = 0; p < partition_count; ++p) {
    int halves[48];
    for (int t = 0; t < 16; ++t) {
      const bool second = ((partitions[static_cast<std::size_t>(p)] >> t) & 1) != 0;
      const int along = 15000 + 37 * (t * 7 % 16);
      halves[3 * t] = second ? 15200 : along, halves[3 * t + 1] = second ? along : 15600,
                 halves[3 * t + 2] = 15000;
    }
    std::array<float, partition_count> estimates{};
    const float one =
        rank_partitions(make_targets(halves, equal_importance, false, error_scale()->values()), estimates);
    const auto best = std::min_element(estimates.begin(), estimates.end()) - estimates.begin();
    EXPECT_EQ(best, p);
    EXPECT_LT(estimates[static_cast<std::size_t>(p)], one);
  }
}

TEST(Bc6hKernels, LinearErrorScaleIncreasesAndCountsDifferences) {
  for (double above : {0.001, 3.0, 1e4}) {
    const ErrorScale scale(above);
    for (int h = -0x7c00; h < 0x7c00; ++h) ASSERT_LT(scale.values()[h], scale.values()[h + 1]) << h;
  }
  // From 32768 to 65504 the logarithm adds ln 2, the difference 32736 / 3 (0x7800 and 0x7bff are these halves).
  const ErrorScale scale(3);
  EXPECT_NEAR(scale.values()[0x7bff] - scale.values()[0x7800], 32736.0 / 3 + std::log(2.0), 0.02);
}

TEST(Bc6hKernels, ErrorScaleIncreases) {
  for (int h = -0x7c00; h < 0x7c00; ++h)
    ASSERT_LT(error_scale()->values()[h], error_scale()->values()[h + 1]) << h;
  EXPECT_EQ(error_scale()->values()[0], 0);
  EXPECT_NEAR(error_scale()->values()[0x3c00], std::log(2.0) * (1 + 15.0 / 512),
              1e-6);  // x = 1; half 15 octaves above 0
}

}  // namespace
}  // namespace welkin::bc6h
