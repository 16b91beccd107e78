#include <welkin/image/z_test.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace welkin {
namespace {

// Pixels of a mean, known up to normal noise, with the standard error that `replicates` values of that noise tell; 0: the
// true one.
struct Noisy {
  Image mean{64, 48}, error{64, 48};
  std::optional<double> freedom;
  MeasuredImage measured() const { return {&mean, &error, freedom}; }
};

Noisy noisy(unsigned seed, int replicates, double bias = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Noisy result;
  if (replicates > 0) result.freedom = replicates - 1;
  for (std::size_t i = 0; i < result.mean.pixels.size(); ++i) {
    const double truth = 3 + std::sin(0.1 * static_cast<double>(i)),
                 sigma = 0.1 + 0.01 * static_cast<double>(i % 7);
    double sum = 0, squares = 0;
    const int values = std::max(1, replicates);
    for (int r = 0; r < values; ++r) {
      const double value = sigma * std::sqrt(values) * normal(random);
      sum += value, squares += value * value;
    }
    const double spread = (squares - sum * sum / values) / std::max(1, values - 1);
    result.mean.pixels[i] = static_cast<float>(truth + bias * sigma + sum / values);
    result.error.pixels[i] = static_cast<float>(replicates > 0 ? std::sqrt(spread / values) : sigma);
  }
  return result;
}

// 9216 scores. Shares beyond 2 and 3: binomial, four standard deviations are 0.0087 and 0.0022; the mean of the squares
// is 1 +- 4 sqrt(2 / 9216) = 0.059, and for scores that went through Wallace's approximation 1 % more.
TEST(ZTest, EqualPicturesAreWithinTheirErrors) {
  for (const int replicates : {0, 8, 16}) {
    const Noisy a = noisy(1, replicates), b = noisy(2, replicates);
    const ZTest test = z_test(a.measured(), b.measured());
    EXPECT_EQ(test.count, 9216u);
    EXPECT_EQ(test.faults, 0u);
    EXPECT_NEAR(test.share_beyond_2, share_expected_beyond_2, 0.0087) << replicates;
    EXPECT_NEAR(test.share_beyond_3, share_expected_beyond_3, 0.0022) << replicates;
    EXPECT_NEAR(test.mean_square, 1, 0.07) << replicates;
    EXPECT_TRUE(test.equal) << replicates;
    EXPECT_LT(std::abs(test.mean_score), 4);
    EXPECT_LT(std::abs(test.mean_square_score), 5);
  }
}

// Probabilities of scores are uniform: Kolmogorov's distance of n of them to the diagonal is below 1.95 / sqrt(n) with
// probability 0.999. One picture is exact here, so that the scores are independent normals.
TEST(ZTest, ProbabilitiesAreUniform) {
  std::vector<double> probabilities;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Noisy exact = noisy(7, 0), b = noisy(100 + seed, 8);
    for (std::size_t i = 0; i < exact.mean.pixels.size(); ++i)
      exact.mean.pixels[i] = static_cast<float>(3 + std::sin(0.1 * static_cast<double>(i)));
    probabilities.push_back(z_test(b.measured(), {&exact.mean, nullptr, {}}).worst_probability);
  }
  std::sort(probabilities.begin(), probabilities.end());
  double distance = 0;
  for (std::size_t i = 0; i < probabilities.size(); ++i)
    distance = std::max(distance, std::abs(probabilities[i] - (static_cast<double>(i) + 0.5) / 100));
  EXPECT_LT(distance,
            0.2);  // 1.95 / sqrt(100); Wallace's tail at seven degrees of freedom is off by a few percent
}

TEST(ZTest, OnePixelOffIsFound) {
  const Noisy a = noisy(1, 8);
  Noisy b = noisy(2, 8);
  b.mean.at(40, 30)[1] += 40 * b.error.at(40, 30)[1];
  const ZTest test = z_test(a.measured(), b.measured());
  EXPECT_FALSE(test.equal);
  EXPECT_EQ(test.worst_x, 40);
  EXPECT_EQ(test.worst_y, 30);
  EXPECT_EQ(test.worst_channel, 1);
  EXPECT_LT(test.worst_score, -5);
  EXPECT_LT(test.worst_probability, 0.005);
}

// A fifth of a standard error everywhere: no pixel shows it, the mean does.
TEST(ZTest, SmallBiasEverywhereIsFound) {
  const ZTest test = z_test(noisy(1, 8, 0.2).measured(), noisy(2, 8).measured());
  EXPECT_GT(test.worst_probability, 0.01);
  EXPECT_GT(test.mean_score, 5);
  EXPECT_FALSE(test.equal);
}

TEST(ZTest, UnderstatedErrorsAreFound) {
  Noisy a = noisy(1, 0), b = noisy(2, 0);
  for (Image* error : {&a.error, &b.error})
    for (float& value : error->pixels) value *= 0.7f;
  const ZTest test = z_test(a.measured(), b.measured());
  EXPECT_NEAR(test.mean_square, 1 / 0.49, 0.15);
  EXPECT_GT(test.mean_square_score, 10);
}

TEST(ZTest, ExactAndFaultyValues) {
  Image a(2, 1), b(2, 1), zero(2, 1);
  a.pixels = b.pixels = {1, 2, 3, 4, 5, 6};
  ZTest test = z_test({&a, &zero, 7}, {&b, nullptr, {}});
  EXPECT_EQ(test.exact, 6u);
  EXPECT_EQ(test.count, 0u);
  EXPECT_TRUE(test.equal);
  b.pixels[4] = 5.001f;
  test = z_test({&a, &zero, 7}, {&b, nullptr, {}});
  EXPECT_EQ(test.faults, 1u);
  EXPECT_FALSE(test.equal);
  b.pixels[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(z_test({&a, &zero, 7}, {&b, nullptr, {}}).equal);
}

// Student's density integrated by Simpson's rule, against the normal tail.
double student_tail(double t, double v) {
  const double scale =
      std::exp(std::lgamma((v + 1) / 2) - std::lgamma(v / 2)) / std::sqrt(v * std::numbers::pi);
  const int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double x = t * i / steps, weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * std::pow(1 + x * x / v, -(v + 1) / 2);
  }
  return 0.5 - scale * sum * t / steps / 3;
}

TEST(ZTest, NormalScoreKeepsProbabilities) {
  for (const double v : {7.0, 14.0, 60.0})
    for (const double t : {0.3, 1.0, 2.0, 3.0, 4.5, 6.0}) {
      const double z = normal_score(t, v);
      // Where the tail of z equals that of t: one step of Newton's method from z.
      const double tail = 0.5 * std::erfc(z / std::numbers::sqrt2);
      const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
      EXPECT_LT(std::abs((tail - student_tail(t, v)) / density), 0.016) << v << " " << t;
      EXPECT_EQ(normal_score(-t, v), -z);
    }
  EXPECT_EQ(normal_score(2.5, std::numeric_limits<double>::infinity()), 2.5);
}

}  // namespace
}  // namespace welkin
