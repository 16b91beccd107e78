#include <welkin/sh/basis.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <welkin/sampling/quadrature.h>
#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

// The published values (Kautz 2006; Ramamoorthi & Hanrahan 2001, equation 3) fix sign, order and normalisation.
TEST(ShBasis, HasThePublishedConstants) {
  const Vec3 d = normalized({0.3, -0.5, 0.8});
  std::vector<double> y(9);
  evaluate_sh_basis(d, 2, y);
  EXPECT_NEAR(y[0], 0.282095, 1e-6);
  EXPECT_NEAR(y[1], 0.488603 * d.y, 1e-6);
  EXPECT_NEAR(y[2], 0.488603 * d.z, 1e-6);
  EXPECT_NEAR(y[3], 0.488603 * d.x, 1e-6);
  EXPECT_NEAR(y[4], 1.092548 * d.x * d.y, 1e-6);
  EXPECT_NEAR(y[5], 1.092548 * d.y * d.z, 1e-6);
  EXPECT_NEAR(y[6], 0.315392 * (3 * d.z * d.z - 1), 1e-6);
  EXPECT_NEAR(y[7], 1.092548 * d.x * d.z, 1e-6);
  EXPECT_NEAR(y[8], 0.546274 * (d.x * d.x - d.y * d.y), 1e-6);
}

TEST(ShBasis, ListingEqualsRecurrence) {
  std::mt19937 random(1);
  std::vector<Vec3> directions{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
  for (int i = 0; i < 1000; ++i) directions.push_back(random_direction(random));
  for (const Vec3& d : directions) {
    std::vector<double> y(25);
    evaluate_sh_basis(d, 4, y);
    const auto listed = sh_basis_degree4(d);
    for (int i = 0; i < 25; ++i)
      ASSERT_NEAR(y[i], listed[i], 1e-14) << "index " << i;  // a few roundings of values below 2
  }
}

// Gauss-Legendre in z and equal steps in phi integrate products of two functions of degree 12 exactly.
TEST(ShBasis, IsOrthonormal) {
  constexpr int degree = 12;
  const QuadratureRule rule = gauss_legendre(degree + 1);
  const int azimuths = 2 * degree + 1;
  std::vector<double> gram(sh_count(degree) * sh_count(degree)), y(sh_count(degree));
  for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
    for (int i = 0; i < azimuths; ++i) {
      const double z = rule.nodes[k], r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * i / azimuths;
      evaluate_sh_basis({r * std::cos(phi), r * std::sin(phi), z}, degree, y);
      const double weight = rule.weights[k] * 2 * std::numbers::pi / azimuths;
      for (std::size_t a = 0; a < y.size(); ++a)
        for (std::size_t b = 0; b < y.size(); ++b) gram[a * y.size() + b] += weight * y[a] * y[b];
    }
  }
  for (std::size_t a = 0; a < y.size(); ++a)
    for (std::size_t b = 0; b < y.size(); ++b) ASSERT_NEAR(gram[a * y.size() + b], a == b ? 1 : 0, 1e-13);
}

// Addition theorem: sum over m of Y_lm(d)^2 = (2l + 1)/(4 pi) in every direction; it fails at once where a recurrence
// is unstable or a start underflows.
TEST(ShBasis, KeepsTheAdditionTheoremToDegree1023AndBeyond) {
  std::mt19937 random(2);
  std::vector<Vec3> directions{{0, 0, 1}, {1, 0, 0}, normalized({1e-3, 0, 1}), normalized({0.02, 0.01, -1})};
  for (int i = 0; i < 4; ++i) directions.push_back(random_direction(random));
  constexpr int degree = 1500;
  std::vector<double> y(sh_count(degree));
  for (const Vec3& d : directions) {
    evaluate_sh_basis(d, degree, y);
    for (int l : {1, 100, 511, 1023, 1500}) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += y[sh_index(l, m)] * y[sh_index(l, m)];
      // Near the pole the rounding of cos theta moves theta by 1e-16 / sin theta = 1e-13, times the degree.
      EXPECT_NEAR(sum * 4 * std::numbers::pi / (2 * l + 1), 1, 2e-10) << "l = " << l;
    }
  }
}

TEST(CosineLobe, HasThePublishedFactors) {
  const auto a = cosine_lobe(8);
  const double pi = std::numbers::pi;
  const double expected[] = {pi, 2 * pi / 3, pi / 4, 0, -pi / 24, 0, pi / 64, 0, -pi / 128};
  for (int l = 0; l <= 8; ++l) EXPECT_NEAR(a[l], expected[l], 1e-15 * pi) << "l = " << l;
}

// Any degree against A_l = 2 pi integral over [0, 1] of x P_l(x) dx, which Gauss-Legendre gives exactly.
TEST(CosineLobe, EqualsItsIntegral) {
  const auto a = cosine_lobe(60);
  const QuadratureRule rule = gauss_legendre(40);
  for (int l = 0; l <= 60; ++l) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double x = 0.5 * (1 + rule.nodes[i]);
      sum += 0.5 * rule.weights[i] * 2 * std::numbers::pi * x * std::legendre(l, x);
    }
    EXPECT_NEAR(a[l], sum, 1e-13) << "l = " << l;
  }
}

}  // namespace
}  // namespace welkin
