#include <welkin/sh/nonnegative.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/minimum.h>

#include "nonnegative_oracle.h"

namespace welkin {
namespace {

using Nine = std::array<double, 9>;

double dot9(const Nine& a, const Nine& b) {
  double sum = 0;
  for (int i = 0; i < 9; ++i) sum += a[i] * b[i];
  return sum;
}

Nine minus(const Nine& a, const Nine& b) {
  Nine out;
  for (int i = 0; i < 9; ++i) out[i] = a[i] - b[i];
  return out;
}

Nine basis_at(Vec3 n) {
  Nine y;
  evaluate_sh_basis(n, 2, y);
  return y;
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

// Irradiance of distant lights: A_l Y_lm(d) summed.
Nine lights(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> uniform;
  const auto cosine = cosine_lobe(2);
  Nine f{};
  for (int i = 0; i < count; ++i) {
    const Nine y = basis_at(random_direction(random));
    const double power = 0.1 + uniform(random);
    for (int k = 0; k < 9; ++k) f[k] += power * cosine[k == 0 ? 0 : k < 4 ? 1 : 2] * y[k];
  }
  return f;
}

Nine noise(std::mt19937& random, double constant) {
  std::normal_distribution<double> normal;
  Nine f;
  for (double& v : f) v = normal(random);
  f[0] += constant;
  return f;
}

// One to six lights, noise about zero, and noise about constants that leave one zero, few, or none.
Nine sample_function(int i, std::mt19937& random) {
  switch (i % 4) {
    case 0: return lights(random, 1 + i / 4 % 6);
    case 1: return noise(random, 0);
    case 2: return noise(random, 3);
    default: return noise(random, -2);
  }
}

double largest(const Nine& f) {
  double out = 0;
  for (double v : f) out = std::max(out, std::abs(v));
  return out;
}

void expect_proven(const NonnegativeFit& fit) {
  EXPECT_TRUE(fit.converged);
  EXPECT_TRUE(proves_nonnegative(fit.coefficients, fit.multiplier));
  EXPECT_GE(minimum_degree2(fit.coefficients), 0);
}

// p = q - f is a positive combination of Y(n) exactly where its moment matrix is positive semidefinite.
void expect_optimal(const Nine& f, const Nine& q, double tolerance) {
  const Nine p = minus(q, f);
  EXPECT_NEAR(dot9(p, q), 0, tolerance);
  auto x = oracle::moment_matrix(p);
  for (int i = 0; i < 4; ++i) x[i][i] += tolerance;
  EXPECT_TRUE(oracle::is_positive_definite(x));
  EXPECT_GE(minimum_degree2(q), 0);
}

TEST(NonnegativeFit, EqualsTheBarrierMethodOnAThousandFunctions) {
  std::mt19937 random(7);
  std::vector<double> errors;
  int changed = 0;
  for (int i = 0; i < 1000; ++i) {
    const Nine f = sample_function(i, random);
    const NonnegativeFit fit = nonnegative_fit(f);
    ASSERT_NO_FATAL_FAILURE(expect_proven(fit)) << i;
    changed += fit.changed;
    errors.push_back(largest(minus(fit.coefficients, oracle::nearest_nonnegative(f))) / largest(f));
  }
  EXPECT_GT(changed, 700);
  EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 1e-9);
}

TEST(NonnegativeFit, MeetsTheOptimalityConditions) {
  std::mt19937 random(8);
  for (int i = 0; i < 4000; ++i) {
    const Nine f = sample_function(i, random);
    const NonnegativeFit fit = nonnegative_fit(f);
    // The conditions hold to 1e-12 in the solver, and to the lift.
    ASSERT_NO_FATAL_FAILURE(expect_optimal(f, fit.coefficients, 1e-11 * largest(f))) << i;
    ASSERT_LE(fit.lift, 1e-12 * largest(f));
    ASSERT_LT(fit.iterations, 100);
  }
}

// The projection's own inequality, <q - f, h - q> >= 0 for every h that is not negative: h is a sum of squares.
TEST(NonnegativeFit, IsNearerThanAnyOther) {
  std::mt19937 random(9);
  for (int i = 0; i < 200; ++i) {
    const Nine f = sample_function(i, random);
    const Nine q = nonnegative_fit(f).coefficients;
    for (int j = 0; j < 50; ++j) {
      const Nine h = nonnegative_fit(noise(random, 2)).coefficients;
      ASSERT_GE(dot9(minus(q, f), minus(h, q)), -1e-11 * largest(f) * (largest(h) + largest(q)));
    }
  }
}

// One distant light, irradiance max(0, x) of x = n.d: the fit is k (x + s)^2. For a given s, least squares over the
// sphere says k = I(s) / D(s), I = integral of (x + s)^2 max(0, x) = 1/4 + 2 s/3 + s^2/2, D = integral of (x + s)^4 =
// 2 (1/5 + 2 s^2 + s^4), and the best s makes I^2 / D largest.
TEST(NonnegativeFit, OfOneLightIsTheKnownSquare) {
  const Vec3 d = normalized({0.3, -0.2, 0.7});
  const auto cosine = cosine_lobe(2);
  Nine f = basis_at(d);
  for (int k = 0; k < 9; ++k) f[k] *= cosine[k == 0 ? 0 : k < 4 ? 1 : 2];
  const NonnegativeFit fit = nonnegative_fit(f);
  expect_proven(fit);
  EXPECT_TRUE(fit.changed);
  const Vec3 side = normalized(cross(d, {1, 0, 0}));
  const auto value = [&](double x) {
    return dot9(fit.coefficients, basis_at(x * d + std::sqrt(1 - x * x) * side));
  };
  const double at_pole = value(1), at_zero = value(0);
  const double s = 1 / (std::sqrt(at_pole / at_zero) - 1), k = at_zero / (s * s);
  double best = 0, best_s = 0, best_k = 0;
  for (double t = 0.4; t < 0.6; t += 1e-7) {
    const double i = 0.25 + 2 * t / 3 + t * t / 2, d4 = 2 * (0.2 + 2 * t * t + t * t * t * t);
    if (i * i / d4 > best) {
      best = i * i / d4;
      best_s = t;
      best_k = i / d4;
    }
  }
  EXPECT_NEAR(s, best_s, 2e-7);  // the scan's step and the flatness of a maximum
  EXPECT_NEAR(k, best_k, 2e-7);
  double squares = 0, most = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = (2 * i + 1) / 1000.0 - 1, error = value(x) - std::max(0.0, x);
    EXPECT_NEAR(value(x), k * (x + s) * (x + s), 1e-11);
    squares += error * error / 1000;
    most = std::max(most, std::abs(error));
  }
  EXPECT_NEAR(std::sqrt(squares), 0.046, 0.0005);
  EXPECT_NEAR(std::max(most, std::abs(value(0))), 0.121, 0.0015);  // both as published figures have them
}

TEST(NonnegativeFit, LeavesNonNegativeFunctionsAsTheyAre) {
  std::mt19937 random(10);
  for (int i = 0; i < 500; ++i) {
    const Nine f = noise(random, 12);  // 3.4 against values that stay below 3.2 in this run
    const NonnegativeFit fit = nonnegative_fit(f);
    ASSERT_EQ(fit.changed, minimum_degree2(f) < 0);
    ASSERT_EQ(fit.coefficients == f, !fit.changed);
    ASSERT_NO_FATAL_FAILURE(expect_proven(fit));
    const NonnegativeFit again = nonnegative_fit(nonnegative_fit(noise(random, 0)).coefficients);
    ASSERT_FALSE(again.changed);  // what the fit made is proven, so a second fit changes nothing
    ASSERT_EQ(again.lift, 0);
  }
}

TEST(NonnegativeFit, TakesDegenerateFunctions) {
  const Nine zero{};
  EXPECT_EQ(nonnegative_fit(zero).coefficients, zero);
  EXPECT_FALSE(nonnegative_fit(zero).changed);
  expect_proven(nonnegative_fit(zero));
  EXPECT_EQ(nonnegative_fit(Nine{-3}).coefficients, zero);
  EXPECT_TRUE(nonnegative_fit(Nine{-3}).changed);
  EXPECT_EQ(nonnegative_fit(Nine{3}).coefficients, Nine{3});

  std::vector<Nine> functions;
  for (int i = 0; i < 9; ++i) {
    for (double sign : {-1.0, 1.0}) {
      Nine f{};
      f[i] = sign;
      functions.push_back(f);
      for (double constant : {-1.0, -0.1, 1e-9, 0.1, 1.0}) {
        f[0] += constant;
        functions.push_back(f);
      }
    }
  }
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {  // zonal functions about any axis, the axis z exactly in one of four
    const Vec3 d = i % 4 == 0 ? Vec3{0, 0, 1} : random_direction(random);
    Nine f = basis_at(d);
    const double bands[3] = {normal(random), normal(random), normal(random)};
    for (int k = 0; k < 9; ++k) f[k] *= bands[k == 0 ? 0 : k < 4 ? 1 : 2];
    functions.push_back(f);
  }
  for (int i = 0; i < 500; ++i) {  // minus a few Y(n): on the edge of those whose answer is 0
    Nine f{};
    for (int j = 0; j <= i % 5; ++j) f = minus(f, basis_at(random_direction(random)));
    functions.push_back(f);
  }
  for (const Nine& f : functions) {
    const NonnegativeFit fit = nonnegative_fit(f);
    ASSERT_NO_FATAL_FAILURE(expect_proven(fit));
    ASSERT_NO_FATAL_FAILURE(expect_optimal(f, fit.coefficients, 2e-11 * std::max(largest(f), 1e-3)));
    ASSERT_LT(fit.iterations, 200);
  }
}

TEST(NonnegativeFit, KeepsItsDigitsAtAnyScale) {
  std::mt19937 random(12);
  const Nine f = lights(random, 3), expected = nonnegative_fit(f).coefficients;
  for (int exponent : {-1000, -300, -20, 20, 300, 1000}) {
    Nine scaled;
    for (int i = 0; i < 9; ++i) scaled[i] = std::ldexp(f[i], exponent);
    const NonnegativeFit fit = nonnegative_fit(scaled);
    expect_proven(fit);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(std::ldexp(fit.coefficients[i], -exponent), expected[i], 1e-12);
  }
}

double nine_digits(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 8).ptr;
  double back = 0;
  std::from_chars(text, end, back);
  return back;
}

TEST(NonnegativeFit, KeepsItsPromiseForRoundedNumbers) {
  std::mt19937 random(13);
  for (int i = 0; i < 1000; ++i) {
    Nine f = sample_function(i, random);
    const double scale = std::pow(10.0, i % 13 - 6);
    for (double& v : f) v *= scale;
    const Nine exact = nonnegative_fit(f).coefficients;
    const NonnegativeFit floats = nonnegative_fit(f, CoefficientRounding::to_float);
    const NonnegativeFit digits = nonnegative_fit(f, CoefficientRounding::to_digits9);
    ASSERT_NO_FATAL_FAILURE(expect_proven(floats));
    ASSERT_NO_FATAL_FAILURE(expect_proven(digits));
    for (int k = 0; k < 9; ++k) {
      ASSERT_EQ(floats.coefficients[k], static_cast<double>(static_cast<float>(floats.coefficients[k])));
      ASSERT_EQ(digits.coefficients[k], nine_digits(digits.coefficients[k]));
      // Eight roundings of half a unit each move the minimum, and the constant makes up for it.
      ASSERT_NEAR(floats.coefficients[k], exact[k], 2e-6 * 0.5 * largest(f));
      ASSERT_NEAR(digits.coefficients[k], exact[k], 1e-7 * largest(f));
    }
  }
}

TEST(ProvesNonnegative, RefusesWhatIsNegativeAnywhere) {
  std::mt19937 random(14);
  for (int i = 0; i < 300; ++i) {
    const NonnegativeFit fit = nonnegative_fit(lights(random, 1));  // a circle of zeros: one multiplier only
    ASSERT_TRUE(proves_nonnegative(fit.coefficients, fit.multiplier));
    Nine below = fit.coefficients;
    below[0] -= (minimum_degree2(below) + 1e-14 * largest(below)) * 2 * std::sqrt(std::numbers::pi);
    for (double shift : {-1.0, -1e-3, -1e-12, -1e-14, 0.0, 1e-14, 1e-12, 1e-3, 1.0})
      ASSERT_FALSE(proves_nonnegative(below, fit.multiplier + shift * largest(below)));
    ASSERT_FALSE(proves_nonnegative(fit.coefficients, fit.multiplier + 0.01 * largest(below)));
    ASSERT_FALSE(proves_nonnegative(fit.coefficients, fit.multiplier - 0.01 * largest(below)));
  }
  EXPECT_FALSE(proves_nonnegative(Nine{1}, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(proves_nonnegative(Nine{1}, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(proves_nonnegative(Nine{-1e-310}, 0));
  EXPECT_TRUE(proves_nonnegative(Nine{1e-310}, 1e-311));
}

TEST(NonnegativeFit, OfDegreesZeroAndOneIsClosed) {
  std::mt19937 random(15);
  std::normal_distribution<double> normal;
  const double a = std::sqrt(3.0);  // q >= 0 where f_0 >= a |v|; the polar cone is p_0 >= |v| / a
  int changed = 0, zero = 0;
  for (int i = 0; i < 500; ++i) {
    ShCoefficients f(1, 3);
    for (double& v : f.values) v = normal(random);
    std::vector<NonnegativeFit> fits;
    const ShCoefficients q = nonnegative_fit(f, CoefficientRounding::none, &fits);
    ASSERT_EQ(fits.size(), 3u);
    for (int c = 0; c < 3; ++c) {
      double q2 = 0, p2 = 0, inner = 0;
      for (int k = 0; k < 4; ++k) {
        const double qk = q.values[3 * k + c], pk = qk - f.values[3 * k + c];
        inner += qk * pk;
        if (k > 0) q2 += qk * qk;
        if (k > 0) p2 += pk * pk;
      }
      ASSERT_NEAR(inner, 0, 1e-11);  // the lift, 1e-12, times values of a few units
      ASSERT_GE(q.values[c] - a * std::sqrt(q2), 0);
      ASSERT_GE(q.values[c] - f.values[c] - std::sqrt(p2) / a, -1e-12);
      ASSERT_NO_FATAL_FAILURE(expect_proven(fits[c]));
      changed += fits[c].changed;
      zero += q.values[c] == 0;
    }
  }
  EXPECT_GT(changed, 500);
  EXPECT_GT(zero, 100);
  ShCoefficients constant(0, 2);
  constant.values = {-1, 2};
  EXPECT_EQ(nonnegative_fit(constant).values, (std::vector<double>{0, 2}));
}

TEST(NonnegativeFit, TakesEveryChannelAlone) {
  std::mt19937 random(16);
  const Nine f[3] = {lights(random, 1), noise(random, 9), noise(random, -1)};
  ShCoefficients together(2, 3);
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < 9; ++k) together.values[3 * k + c] = f[c][k];
  std::vector<NonnegativeFit> fits;
  const ShCoefficients q = nonnegative_fit(together, CoefficientRounding::to_float, &fits);
  for (int c = 0; c < 3; ++c) {
    const NonnegativeFit alone = nonnegative_fit(f[c], CoefficientRounding::to_float);
    EXPECT_EQ(fits[c].coefficients, alone.coefficients);
    EXPECT_EQ(fits[c].multiplier, alone.multiplier);
    for (int k = 0; k < 9; ++k) EXPECT_EQ(q.values[3 * k + c], alone.coefficients[k]);
  }
}

TEST(NonnegativeFit, RefusesWhatItCannotTake) {
  EXPECT_THROW(nonnegative_fit(ShCoefficients(3, 3)), Error);
  ShCoefficients f(2, 1);
  f.values[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(nonnegative_fit(f), Error);
  f.values[4] = 1e39;
  EXPECT_THROW(nonnegative_fit(f, CoefficientRounding::to_float), Error);
}

}  // namespace
}  // namespace welkin
