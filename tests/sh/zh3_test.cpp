#include <welkin/sh/zh3.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/minimum.h>
#include <welkin/sh/nonnegative.h>

namespace welkin {
namespace {

using Nine = std::array<double, 9>;

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

// Irradiance of coloured distant lights over a grey ambient term.
ShCoefficients probe(std::mt19937& random, int lights) {
  std::uniform_real_distribution<double> uniform;
  ShCoefficients radiance(2, 3);
  for (int c = 0; c < 3; ++c) radiance.values[c] = 0.3 * uniform(random);
  for (int i = 0; i < lights; ++i) {
    Nine y;
    evaluate_sh_basis(random_direction(random), 2, y);
    for (int c = 0; c < 3; ++c) {
      const double power = 0.1 + uniform(random);
      for (int k = 0; k < 9; ++k) radiance.values[3 * k + c] += power * y[k];
    }
  }
  return convolve(radiance, cosine_lobe(2));
}

Nine channel(const ShCoefficients& f, int c) {
  Nine out;
  for (int i = 0; i < 9; ++i) out[i] = f.values[i * f.channels + c];
  return out;
}

double squared_distance(const ShCoefficients& a, const ShCoefficients& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    sum += (a.values[i] - b.values[i]) * (a.values[i] - b.values[i]);
  return sum;
}

TEST(Zh3, EvaluatesAsItsNineCoefficients) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const Zh3 z = fit_zh3(probe(random, 3), random_direction(random));
    const Vec3 n = random_direction(random);
    double direct[3], nine[3];
    evaluate(z, n, direct);
    evaluate(zh3_to_sh(z), n, nine);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(direct[c], nine[c], 1e-14);
  }
}

// One light: the function is zonal about it, and every kind of axis finds it, so nothing is lost.
TEST(Zh3, OfOneLightIsExact) {
  std::mt19937 random(2);
  const Vec3 d = random_direction(random);
  Nine y;
  evaluate_sh_basis(d, 2, y);
  const auto cosine = cosine_lobe(2);
  ShCoefficients f(2, 3);
  for (int k = 0; k < 9; ++k)
    for (int c = 0; c < 3; ++c) f.values[3 * k + c] = (c + 1) * cosine[k == 0 ? 0 : k < 4 ? 1 : 2] * y[k];
  EXPECT_NEAR(dot(zh3_luminance_axis(f), d), 1, 1e-15);
  EXPECT_NEAR(std::abs(dot(zh3_best_axis(f), d)), 1, 1e-14);
  EXPECT_LT(squared_distance(zh3_to_sh(fit_zh3(f, zh3_luminance_axis(f))), f), 1e-28);
  EXPECT_LT(squared_distance(zh3_to_sh(fit_zh3(f, zh3_best_axis(f))), f), 1e-28);
}

// The coefficient is the projection: any other one is farther away; degree 2 loses exactly what is left.
TEST(Zh3, CoefficientIsTheNearest) {
  std::mt19937 random(3);
  const ShCoefficients f = probe(random, 4);
  const Zh3 z = fit_zh3(f, random_direction(random));
  const double distance = squared_distance(zh3_to_sh(z), f);
  double norm = 0;
  for (int k = 4; k < 9; ++k)
    for (int c = 0; c < 3; ++c) norm += f.values[3 * k + c] * f.values[3 * k + c];
  for (double part : z.zonal) norm -= part * part;
  EXPECT_NEAR(distance, norm, 1e-14);
  for (int c = 0; c < 3; ++c) {
    Zh3 other = z;
    other.zonal[c] += 1e-3;
    EXPECT_NEAR(squared_distance(zh3_to_sh(other), f), distance + 1e-6, 1e-14);
  }
}

// Against the best of 20,000 directions; the published axis is never better.
TEST(Zh3, BestAxisIsTheBestOfManyDirections) {
  std::mt19937 random(4);
  std::vector<Vec3> directions(20000);
  for (Vec3& d : directions) d = random_direction(random);
  double best_sum = 0, luminance_sum = 0;
  for (int i = 0; i < 60; ++i) {
    const ShCoefficients f = probe(random, 1 + i % 6);
    const auto distance_of = [&](Vec3 axis) { return squared_distance(zh3_to_sh(fit_zh3(f, axis)), f); };
    double sampled = std::numeric_limits<double>::max();
    for (const Vec3& d : directions) sampled = std::min(sampled, distance_of(d));
    const double best = distance_of(zh3_best_axis(f));
    ASSERT_LE(best, sampled + 1e-14) << i;
    best_sum += std::sqrt(best);
    luminance_sum += std::sqrt(distance_of(zh3_luminance_axis(f)));
  }
  EXPECT_LT(best_sum, 0.9 * luminance_sum);
}

// The published formula in radiance, on numbers that are easy to follow: L_00 = 1, L_10 = 0.5, so r = 0.5.
TEST(Zh3, HallucinatesAsPublished) {
  ShCoefficients radiance(1, 1);
  radiance.values = {1, 0, 0.5, 0};
  const Zh3 z = hallucinate_zh3(convolve(radiance, cosine_lobe(1)));
  EXPECT_NEAR(z.axis.z, 1, 1e-15);
  const double radiance_zonal = 0.08 * 0.5 + 0.6 * 0.25;
  EXPECT_NEAR(z.zonal[0], std::numbers::pi / 4 * radiance_zonal, 1e-15);
  EXPECT_EQ(hallucinate_zh3(ShCoefficients(1, 3)).zonal, (std::vector<double>{0, 0, 0}));
}

// Dykstra's alternating projections between the functions >= 0 and those of the ZH3 form with this axis: slow, and
// another road altogether.
Nine alternating(const Nine& f, Vec3 axis) {
  Nine x = f, correction{};
  for (int i = 0; i < 1500; ++i) {
    Nine y;
    for (int k = 0; k < 9; ++k) y[k] = x[k] + correction[k];
    const Nine q = nonnegative_fit(y).coefficients;
    ShCoefficients nine(2, 1);
    for (int k = 0; k < 9; ++k) {
      correction[k] = y[k] - q[k];
      nine.values[k] = q[k];
    }
    x = channel(zh3_to_sh(fit_zh3(nine, axis)), 0);
  }
  return x;
}

TEST(Zh3, NonNegativeOneIsProvenAndTheNearest) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int changed = 0;
  for (int i = 0; i < 60; ++i) {
    ShCoefficients f = probe(random, 1 + i % 3);
    for (double& v : f.values) v += 0.3 * (i % 3) * normal(random);
    if (i % 5 == 4) f.values[0] -= 4;  // a red that is negative nearly everywhere
    const Vec3 axis = i % 2 ? zh3_best_axis(f) : zh3_luminance_axis(f);
    const Zh3 plain = fit_zh3(f, axis), fit = nonnegative_zh3(plain);
    const ShCoefficients before = zh3_to_sh(plain), after = zh3_to_sh(fit);
    for (int c = 0; c < 3; ++c) {
      const Nine q = channel(after, c), expected = alternating(channel(before, c), axis);
      ASSERT_FALSE(nonnegative_fit(q).changed) << i;  // proven as it is
      changed += channel(before, c) != q;
      // Dykstra's method creeps where the two sets touch at a small angle.
      for (int k = 0; k < 9; ++k) ASSERT_NEAR(q[k], expected[k], 2e-4) << i << ' ' << c << ' ' << k;
      // p = q - f is at right angles to q; the inequality is tested below.
      double inner = 0;
      for (int k = 0; k < 9; ++k) inner += q[k] * (q[k] - channel(before, c)[k]);
      ASSERT_NEAR(inner, 0, 1e-9) << i << ' ' << c;
    }
  }
  EXPECT_GT(changed, 60);
}

TEST(Zh3, NonNegativeOneMeetsItsInequality) {
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i) {
    Zh3 a{ShCoefficients(1, 8), random_direction(random), std::vector<double>(8)};
    for (double& v : a.linear.values) v = normal(random);
    for (double& v : a.zonal) v = normal(random);
    const ShCoefficients f = zh3_to_sh(a), q = zh3_to_sh(nonnegative_zh3(a));
    for (int c = 0; c < 8; ++c) {
      for (int other = 0; other < 8; ++other) {  // every channel's answer is a rival of every other's
        double product = 0;
        for (int k = 0; k < 9; ++k)
          product += (channel(q, c)[k] - channel(f, c)[k]) * (channel(q, other)[k] - channel(q, c)[k]);
        ASSERT_GE(product, -1e-9) << i << ' ' << c << ' ' << other;
      }
    }
  }
}

TEST(Zh3, RefusesWhatItCannotTake) {
  EXPECT_THROW(fit_zh3(ShCoefficients(1, 3), {0, 0, 1}), Error);
  EXPECT_THROW(zh3_best_axis(ShCoefficients(1, 3)), Error);
  EXPECT_THROW(hallucinate_zh3(ShCoefficients(0, 3)), Error);
  ShCoefficients f(2, 3);
  f.values[7] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(fit_zh3(f, {0, 0, 1}), Error);
}

}  // namespace
}  // namespace welkin
