#include <welkin/sh/zonal_harmonics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// f(d) = g(axis . d) with g the zonal function itself.
TEST(ZonalHarmonics, TurnToAnAxis) {
  std::mt19937 random(1);
  const std::vector<double> zonal{1, -0.5, 2, 0.25, -1, 0.3};
  const Vec3 axis = random_unit_vector(random);
  const ShCoefficients turned = turn_zonal(zonal, axis);
  for (int i = 0; i < 20; ++i) {
    const Vec3 d = random_unit_vector(random);
    EXPECT_NEAR(value_in(turned, d)[0], evaluate_zonal(zonal, dot(axis, d)), 1e-14);  // rounding
  }
  const ShCoefficients about_z = turn_zonal(zonal, {0, 0, 1});
  for (int l = 0; l <= 5; ++l) EXPECT_NEAR(about_z.values[sh_index(l, 0)], zonal[l], 1e-15);
}

// The delta samples: its inner product with any function of its degree is the function's value.
TEST(ZonalHarmonics, DeltaReadsTheValue) {
  std::mt19937 random(2);
  const ShCoefficients f = random_coefficients(9, 1, random);
  const Vec3 d = random_unit_vector(random);
  EXPECT_NEAR(inner_product(f, turn_zonal(zonal_delta(9), d))[0], value_in(f, d)[0], 1e-13);
}

// Against 2 pi integral of Y_l0 over the cap, which Gauss-Legendre gives exactly; a sun and a hemisphere and more.
TEST(ZonalHarmonics, CapEqualsItsIntegral) {
  const QuadratureRule rule = gauss_legendre(40);
  for (double radius : {0.0, 1e-5, 0.00465, 0.3, pi / 2, 2.5, pi}) {
    const std::vector<double> cap = zonal_cap(radius, 60);
    const double height = 2 * std::sin(radius / 2) * std::sin(radius / 2);  // 1 - cos
    for (int l = 0; l <= 60; ++l) {
      double sum = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        sum += rule.weights[i] * std::legendre(l, 1 - height * (1 + rule.nodes[i]) / 2);
      const double expected = 2 * pi * std::sqrt((2 * l + 1) / (4 * pi)) * sum * height / 2;
      // The recurrence keeps 13 digits of the cap's area.
      EXPECT_NEAR(cap[l], expected, 1e-12 * (2 * pi * height) + 1e-15) << radius << " " << l;
    }
  }
  // Area times Y_20 at the pole, up to radius^2 of it.
  EXPECT_NEAR(zonal_cap(1e-5, 2)[2] / (pi * 1e-10 * std::sqrt(5 / (4 * pi))), 1, 1e-10);
}

// Light through a cap's worth of clamped cosine: convolution with the zonal function equals its factors.
TEST(ZonalHarmonics, ClampedCosineHasTheFactorsOfIrradiance) {
  const std::vector<double> factors = convolution_factors(zonal_clamped_cosine(6));
  EXPECT_NEAR(factors[0], pi, 1e-15);
  EXPECT_NEAR(factors[1], 2 * pi / 3, 1e-15);
  EXPECT_NEAR(factors[2], pi / 4, 1e-15);
  EXPECT_LT(largest_difference(zonal_coefficients(factors), zonal_clamped_cosine(6)), 1e-15);
  EXPECT_NEAR(evaluate_zonal(zonal_clamped_cosine(400), 0.3), 0.3, 1e-4);  // the series converges like 1/l^2
}

TEST(ZonalHarmonics, RefusesBadArguments) {
  EXPECT_THROW(zonal_cap(-0.1, 3), Error);
  EXPECT_THROW(zonal_cap(3.2, 3), Error);
  EXPECT_THROW(zonal_cap(NAN, 3), Error);
  EXPECT_THROW(zonal_delta(-1), Error);
  EXPECT_THROW(turn_zonal({}, {0, 0, 1}), Error);
}

}  // namespace
}  // namespace welkin
