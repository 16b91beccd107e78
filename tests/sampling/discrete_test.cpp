#include <welkin/sampling/discrete.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include <welkin/error.h>

#include "tests/oracles/chi_square.h"

namespace welkin {
namespace {

TEST(DiscreteDistribution, PicksByWeight) {
  const std::vector<double> weights{3, 0, 1e-3, 5, 0, 2};
  const DiscreteDistribution distribution(weights);
  std::vector<double> seen(6), expected, left(16), even(16, 1'000'000 / 16.0);
  for (double w : weights) expected.push_back(w / 10.001 * 1'000'000);
  std::mt19937 random(5);
  for (int i = 0; i < 1'000'000; ++i) {
    const auto choice = distribution.choose(static_cast<float>(random() >> 8) * 0x1p-24f);
    ASSERT_EQ(choice.probability, distribution.probability(choice.index));
    ASSERT_GT(choice.probability, 0);
    seen[choice.index] += 1;
    left[static_cast<std::size_t>(choice.remainder * 16)] += 1;
  }
  EXPECT_GT(oracle::chi_square(seen, expected).p, oracle::sidak_threshold(0.01, 2));
  EXPECT_GT(oracle::chi_square(left, even).p, oracle::sidak_threshold(0.01, 2));
}

// Every multiple of 2^-24, so nothing is left to chance: the share of an index is its probability exactly.
TEST(DiscreteDistribution, ProbabilityIsTheExactShareOfTheNumbers) {
  const std::vector<double> weights{1, 1e-12, 0, 7, 1e9, 3};
  const DiscreteDistribution distribution(weights);
  std::vector<double> seen(6);
  for (int i = 0; i < 1 << 24; ++i)
    seen[distribution.choose(static_cast<float>(i) * 0x1p-24f).index] += 0x1p-24;
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(seen[k], distribution.probability(k)) << k;
    EXPECT_EQ(seen[k] > 0, weights[k] > 0) << k;
    EXPECT_NEAR(seen[k], weights[k] / 1000000011.0, 6 * 0x1p-24) << k;  // a step each, and rounding
  }
}

// Bisection of all entries is the yardstick: the same index for every end of an interval, its neighbours, and others.
TEST(Cutpoints, FindWhatBisectionFinds) {
  std::mt19937 random(8);
  for (const std::size_t count : {1u, 2u, 7u, 64u, 1000u}) {
    for (const double lit : {1.0, 0.2, 0.0}) {
      std::vector<double> weights(count);
      std::uniform_real_distribution<double> unit(0, 1);
      for (double& w : weights) w = unit(random) < lit ? std::pow(unit(random), 9) : 0.0;
      std::vector<float> cdf(count + 1);
      quantised_cdf(weights.data(), count, cdf.data());
      for (const int intervals : {1, 8, 256}) {
        std::vector<std::uint16_t> cutpoints(intervals + 2);
        make_cutpoints(cdf.data(), count, intervals, cutpoints.data());
        const auto check = [&](float value) {
          const int k = static_cast<int>(value * static_cast<float>(intervals));
          ASSERT_EQ(last_not_above(cdf.data(), cutpoints.data() + k, value),
                    last_not_above(cdf.data(), count, value))
              << count << ' ' << lit << ' ' << intervals << ' ' << value;
        };
        for (int i = 0; i < 2000; ++i) check(static_cast<float>(random() >> 8) * 0x1p-24f);
        for (int k = 0; k < 256; ++k) {
          check(static_cast<float>(k) / 256);
          check(std::nextafter(static_cast<float>(k + 1) / 256, 0.0f));
        }
        for (const float entry : cdf) check(entry);  // 1 itself among them
      }
    }
  }
}

TEST(DiscreteDistribution, OfNothingPicksNothing) {
  EXPECT_TRUE(DiscreteDistribution().empty());
  EXPECT_EQ(DiscreteDistribution().choose(0.5f).probability, 0);
  const std::vector<double> zeros(3);
  EXPECT_TRUE(DiscreteDistribution(zeros).empty());
  EXPECT_EQ(DiscreteDistribution(zeros).choose(0.5f).probability, 0);
}

TEST(DiscreteDistribution, RefusesBadWeights) {
  for (double bad : {-1.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    const std::vector<double> weights{1, bad};
    EXPECT_THROW(DiscreteDistribution{weights}, Error);
  }
}

TEST(DiscreteDistribution, AscendingNumbersPickAscendingIndices) {
  const std::vector<double> weights{2, 0, 5, 1};
  const DiscreteDistribution distribution(weights);
  std::size_t last = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::size_t index = distribution.choose(static_cast<float>(i) / 1000).index;
    ASSERT_GE(index, last);
    last = index;
  }
  EXPECT_EQ(distribution.choose(0x1.fffffep-1f).index, 3u);
}

}  // namespace
}  // namespace welkin
