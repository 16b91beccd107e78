#include <welkin/sh/minimum_search.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/minimum.h>
#include <welkin/sh/rotation.h>
#include <welkin/sh/zonal_harmonics.h>

namespace welkin {
namespace {

// 1 + 0.5 a . d has its minimum 0.5 at -a.
TEST(MinimumSearch, OfALinearFunctionIsKnown) {
  const Vec3 a = normalized({1, -2, 0.5});
  const std::vector<double> zonal{std::sqrt(4 * std::numbers::pi), 0.5 * std::sqrt(4 * std::numbers::pi / 3)};
  const SphereMinimum minimum = find_minimum(turn_zonal(zonal, a));
  EXPECT_NEAR(minimum.value, 0.5, 1e-14);
  EXPECT_NEAR(dot(minimum.where, a), -1, 1e-14);
}

TEST(MinimumSearch, EqualsTheExactMinimumOfDegree2) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const ShCoefficients f = random_coefficients(2, 1, random);
    const double exact = minimum_degree2(std::span<const double, 9>(f.values.data(), 9));
    const SphereMinimum found = find_minimum(f);
    EXPECT_NEAR(found.value, exact, 1e-13);
    EXPECT_NEAR(value_in(f, found.where)[0], found.value, 1e-13);
  }
}

// The best of 20,000 random directions, walked down by a coarse pattern search that knows no derivatives.
double brute_minimum(const ShCoefficients& f, std::mt19937& random) {
  Vec3 best{0, 0, 1};
  double value = INFINITY;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 d = random_unit_vector(random);
    const double v = value_in(f, d)[0];
    if (v < value) value = v, best = d;
  }
  for (double size = 0.1; size > 1e-8; size *= 0.7)
    for (int i = 0; i < 12; ++i) {
      const Vec3 d = normalized(best + size * random_unit_vector(random));
      const double v = value_in(f, d)[0];
      if (v < value) value = v, best = d;
    }
  return value;
}

TEST(MinimumSearch, IsNeverAboveABruteForceSearch) {
  std::mt19937 random(2);
  for (int degree : {1, 3, 4, 7, 11, 16}) {
    for (int i = 0; i < 4; ++i) {
      const ShCoefficients f = random_coefficients(degree, 1, random);
      EXPECT_LT(find_minimum(f).value, brute_minimum(f, random) + 1e-11)
          << degree;  // the search's own error: 1e-15
    }
  }
}

// Two pits of which one is deeper by a millionth, anywhere on the sphere, one of them at a pole.
TEST(MinimumSearch, TellsNearlyEqualMinimaApart) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = i == 0 ? Vec3{0, 0, -1} : random_unit_vector(random);
    // At least 45 degrees from a and from -a.
    const Vec3 b = normalized(normalized(cross(a, random_unit_vector(random))) + (0.02 * i - 1) * a);
    const ShCoefficients deep = turn_zonal(zonal_delta(12), a), shallow = turn_zonal(zonal_delta(12), b);
    const ShCoefficients f = add(scale(deep, -1.000001), scale(shallow, -1));
    EXPECT_GT(dot(find_minimum(f).where, a), 0.99);
  }
}

TEST(MinimumSearch, TurnsWithTheFunction) {
  std::mt19937 random(4);
  const ShCoefficients f = random_coefficients(9, 3, random);
  const Mat3 r = random_rotation(random);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(find_minimum(f, c).value, find_minimum(rotate(f, r), c).value, 1e-12);
    EXPECT_NEAR(value_in(f, find_minimum(f, c).where)[c], find_minimum(f, c).value, 1e-12);
  }
}

TEST(MinimumSearch, RefusesWhatItCannotDo) {
  EXPECT_THROW(find_minimum(ShCoefficients(17, 1)), Error);
  EXPECT_THROW(find_minimum(ShCoefficients(2, 1), 1), Error);
  EXPECT_THROW(find_minimum(ShCoefficients{}), Error);
  ShCoefficients f(2, 1);
  f.values[3] = NAN;
  EXPECT_THROW(find_minimum(f), Error);
}

}  // namespace
}  // namespace welkin
