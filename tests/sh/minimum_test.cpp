#include <welkin/sh/minimum.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <welkin/sh/basis.h>

namespace welkin {
namespace {

using Nine = std::array<double, 9>;

double value(const Nine& f, Vec3 n) {
  std::array<double, 9> y;
  evaluate_sh_basis(n, 2, y);
  double sum = 0;
  for (int i = 0; i < 9; ++i) sum += f[i] * y[i];
  return sum;
}

Nine random_function(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Nine f;
  for (double& v : f) v = normal(random);
  return f;
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

std::vector<Vec3> fibonacci_points(int count) {
  std::vector<Vec3> points(count);
  for (int i = 0; i < count; ++i) {
    const double z = (2 * i + 1.0) / count - 1, r = std::sqrt(1 - z * z);
    const double phi = 2 * std::numbers::pi * i * (std::numbers::phi - 1);
    points[i] = {r * std::cos(phi), r * std::sin(phi), z};
  }
  return points;
}

// The smallest of a dense set, then pattern search down to rounding: nothing in common with the method under test.
double sampled_minimum(const Nine& f, const std::vector<Vec3>& points) {
  Vec3 best = points[0];
  double least = value(f, best);
  for (const Vec3& n : points) {
    const double v = value(f, n);
    if (v < least) {
      least = v;
      best = n;
    }
  }
  for (double step = 0.05; step > 1e-9;) {
    const double before = least;
    for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0},
                          Vec3{0, 0, -1}, Vec3{1, 1, 1}, Vec3{-1, -1, 1}, Vec3{1, -1, -1}}) {
      const Vec3 n = normalized(best + step * d);
      const double v = value(f, n);
      if (v < least) {
        least = v;
        best = n;
      }
    }
    if (least == before) step *= 0.5;
  }
  return least;
}

// What makes a stationary point the global minimum: (A - mu) n = -b and A - mu positive semidefinite.
void expect_optimal(const SphereQuadric& q, double tolerance) {
  const QuadricMinimum m = minimize_on_sphere(q);
  const Vec3 n = m.where;
  EXPECT_NEAR(length(n), 1, 1e-15 * 4);
  const Vec3 an{q.xx * n.x + q.xy * n.y + q.xz * n.z, q.xy * n.x + q.yy * n.y + q.yz * n.z,
                q.xz * n.x + q.yz * n.y + q.zz * n.z};
  EXPECT_LT(length(an + q.b - m.multiplier * n), tolerance);
  const double xx = q.xx - m.multiplier + tolerance, yy = q.yy - m.multiplier + tolerance,
               zz = q.zz - m.multiplier + tolerance;
  EXPECT_GT(xx, 0);
  EXPECT_GT(xx * yy - q.xy * q.xy, -tolerance);
  EXPECT_GT(
      xx * (yy * zz - q.yz * q.yz) - q.xy * (q.xy * zz - q.yz * q.xz) + q.xz * (q.xy * q.yz - yy * q.xz),
      -tolerance);
}

TEST(SphereQuadric, IsTheFunctionAndComesBack) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Nine f = random_function(random);
    const SphereQuadric q = quadric_from_sh(f);
    EXPECT_NEAR(q.xx + q.yy + q.zz, 0, 1e-15);
    const Vec3 n = random_direction(random);
    EXPECT_NEAR(evaluate(q, n), value(f, n), 1e-14);  // a dozen roundings of values of a few units
    Nine back;
    sh_from_quadric(q, back);
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(back[k], f[k], 1e-14);
  }
}

TEST(MinimumDegree2, EqualsDenseSamplingOnRandomFunctions) {
  std::mt19937 random(4);
  const auto points = fibonacci_points(2000);
  for (int i = 0; i < 200; ++i) {
    const Nine f = random_function(random);
    Vec3 where;
    const double minimum = minimum_degree2(f, &where);
    ASSERT_NEAR(minimum, sampled_minimum(f, points),
                1e-13);  // the search ends at steps of 1e-9: 1e-17 in value
    ASSERT_NEAR(value(f, where), minimum, 1e-14);
    Nine negated;
    for (int k = 0; k < 9; ++k) negated[k] = -f[k];
    ASSERT_EQ(maximum_degree2(f), -minimum_degree2(negated));
    ASSERT_NO_FATAL_FAILURE(expect_optimal(quadric_from_sh(f), 2e-14));
  }
}

TEST(MinimumDegree2, OfSingleFunctionsIsKnown) {
  const auto minimum_of = [](int index, double factor) {
    Nine f{};
    f[index] = factor;
    return minimum_degree2(f);
  };
  const double pi = std::numbers::pi;
  EXPECT_EQ(minimum_degree2(Nine{}), 0);
  EXPECT_NEAR(minimum_of(0, 3), 3 * std::sqrt(1 / (4 * pi)), 1e-15);
  EXPECT_NEAR(minimum_of(0, -3), -3 * std::sqrt(1 / (4 * pi)), 1e-15);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(minimum_of(i, 1), -std::sqrt(3 / (4 * pi)), 1e-15);
  for (int i : {4, 5, 7, 8}) EXPECT_NEAR(minimum_of(i, 1), -std::sqrt(15 / (16 * pi)), 1e-15);
  EXPECT_NEAR(minimum_of(6, 1), -std::sqrt(5 / (16 * pi)), 1e-15);       // on the equator, a whole circle
  EXPECT_NEAR(minimum_of(6, -1), -2 * std::sqrt(5 / (16 * pi)), 1e-15);  // at both poles
}

// c + 2 b z + a z^2 about any axis: the vertex of the parabola where it lies within [-1, 1] and opens upwards.
TEST(MinimumDegree2, OfZonalFunctionsIsThatOfAParabola) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    const double a = normal(random), b = normal(random) * (i % 3), c = normal(random);
    const Vec3 n = random_direction(random);
    const SphereQuadric q{a * (n.x * n.x - 1 / 3.0),
                          a * (n.y * n.y - 1 / 3.0),
                          a * (n.z * n.z - 1 / 3.0),
                          a * n.x * n.y,
                          a * n.y * n.z,
                          a * n.x * n.z,
                          b * n,
                          c + a / 3};
    const double vertex = a > 0 && std::abs(b) < a ? c - b * b / a : c + a - 2 * std::abs(b);
    ASSERT_NEAR(minimize_on_sphere(q).value, vertex, 1e-14 * (1 + std::abs(a) + std::abs(b)));
    ASSERT_NO_FATAL_FAILURE(expect_optimal(q, 3e-14));
  }
}

// A = diag(l1, l2, l3) and b without a part along the first axis, shorter than the gaps allow: the minimum has a free
// component along the first axis. Value by the derivation of the secular equation.
TEST(MinimumDegree2, TakesTheHardCase) {
  const double l1 = -1, l2 = 0.25, l3 = 0.75, b2 = 0.5, b3 = -0.7;
  const double x2 = -b2 / (l2 - l1), x3 = -b3 / (l3 - l1), x1 = std::sqrt(1 - x2 * x2 - x3 * x3);
  const double expected = l1 * x1 * x1 + l2 * x2 * x2 + l3 * x3 * x3 + 2 * (b2 * x2 + b3 * x3);
  const SphereQuadric hard{l1, l2, l3, 0, 0, 0, {0, b2, b3}, 0};
  const QuadricMinimum m = minimize_on_sphere(hard);
  EXPECT_NEAR(m.value, expected, 1e-15);
  EXPECT_NEAR(std::abs(m.where.x), x1, 1e-15);
  EXPECT_EQ(m.multiplier, l1);
  // Nearly hard: the part along the first axis shrinks to nothing, and the value goes to the hard one linearly.
  for (double b1 = 1e-3; b1 > 1e-320; b1 *= 1e-3) {
    SphereQuadric nearly = hard;
    nearly.b.x = b1;
    EXPECT_NEAR(minimize_on_sphere(nearly).value, expected - 2 * b1 * x1, b1 * b1 + 2e-15) << b1;
  }
}

TEST(MinimumDegree2, TakesEqualEigenvaluesAndTheEdgeOfTheHardCase) {
  // b in the plane of the two lowest, equal eigenvalues; then b exactly at the edge (|x| = 1 at s = 0).
  expect_optimal({-0.5, -0.5, 1, 0, 0, 0, {3e-9, -4e-9, 0.1}, 0}, 1e-14);
  expect_optimal({-0.5, -0.5, 1, 0, 0, 0, {0, 0, 1.5}, 0}, 1e-14);
  expect_optimal({-0.5, -0.5, 1, 0, 0, 0, {1e-17, 0, 1.5 - 1e-15}, 0}, 1e-14);
  expect_optimal({-1, 0, 1, 0, 0, 0, {1e-20, 0.6, 1.6}, 0}, 1e-14);
  expect_optimal({0, 0, 0, 0, 0, 0, {1e-30, 0, 0}, 1}, 1e-14);
  expect_optimal({1e-17, 0, -1e-17, 0, 1e-17, 0, {0, 1, 0}, 1}, 1e-14);
}

TEST(MinimumDegree2, KeepsItsDigitsAtAnyScale) {
  std::mt19937 random(6);
  const Nine f = random_function(random);
  const double expected = minimum_degree2(f);
  for (int exponent : {-1000, -400, -50, 50, 400, 1000}) {
    Nine scaled;
    for (int i = 0; i < 9; ++i) scaled[i] = std::ldexp(f[i], exponent);
    EXPECT_NEAR(std::ldexp(minimum_degree2(scaled), -exponent), expected, 1e-15) << exponent;
  }
}

}  // namespace
}  // namespace welkin
