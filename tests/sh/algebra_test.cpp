#include <welkin/sh/algebra.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

TEST(ShAlgebra, IsLinearInTheValues) {
  std::mt19937 random(1);
  const ShCoefficients a = random_coefficients(6, 3, random), b = random_coefficients(6, 3, random);
  const ShCoefficients sum = add(a, b), scaled = scale(a, -2.5), mixed = blend(a, b, 0.3);
  const std::vector<double> factors{1, 2, 3};
  const ShCoefficients tinted = scale(a, factors);
  const Vec3 d = random_unit_vector(random);
  const auto fa = value_in(a, d), fb = value_in(b, d);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(value_in(sum, d)[c], fa[c] + fb[c], 1e-12);  // rounding of 49 terms of about 1
    EXPECT_NEAR(value_in(scaled, d)[c], -2.5 * fa[c], 1e-12);
    EXPECT_NEAR(value_in(mixed, d)[c], 0.7 * fa[c] + 0.3 * fb[c], 1e-12);
    EXPECT_NEAR(value_in(tinted, d)[c], (c + 1) * fa[c], 1e-12);
  }
  EXPECT_EQ(blend(a, b, 0).values, a.values);
  EXPECT_EQ(blend(a, b, 1).values, b.values);
}

TEST(ShAlgebra, ResizeCutsAndFillsWithZeros) {
  std::mt19937 random(2);
  const ShCoefficients a = random_coefficients(4, 2, random);
  const ShCoefficients larger = resize(a, 7), smaller = resize(a, 2);
  EXPECT_EQ(larger.values.size(), sh_count(7) * 2);
  EXPECT_EQ(larger.values[sh_index(4, 4) * 2 + 1], a.values.back());
  EXPECT_EQ(larger.values[sh_index(5, -5) * 2], 0);
  EXPECT_EQ(smaller.values.size(), sh_count(2) * 2);
  EXPECT_EQ(smaller.values.back(), a.values[sh_index(2, 2) * 2 + 1]);
  EXPECT_EQ(resize(larger, 4).values, a.values);
}

// The integral of f g by a product rule that is exact for degree 5 + 3.
TEST(ShAlgebra, InnerProductIsTheIntegral) {
  std::mt19937 random(3);
  const ShCoefficients f = random_coefficients(5, 2, random), g = random_coefficients(3, 2, random);
  const QuadratureRule rule = gauss_legendre(5);
  constexpr int azimuths = 9;
  std::vector<double> sums(2);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (int k = 0; k < azimuths; ++k) {
      const double phi = 2 * std::numbers::pi * k / azimuths,
                   r = std::sqrt(1 - rule.nodes[i] * rule.nodes[i]);
      const Vec3 d{r * std::cos(phi), r * std::sin(phi), rule.nodes[i]};
      for (int c = 0; c < 2; ++c)
        sums[c] += rule.weights[i] * 2 * std::numbers::pi / azimuths * value_in(f, d)[c] * value_in(g, d)[c];
    }
  EXPECT_LT(largest_difference(inner_product(f, g), sums), 1e-12);  // rounding
  EXPECT_EQ(inner_product(f, g), inner_product(g, f));
}

TEST(ShAlgebra, RefusesWhatDoesNotFit) {
  const ShCoefficients a(2, 3), other_degree(3, 3), other_channels(2, 1), empty;
  ShCoefficients damaged(2, 3);
  damaged.values.pop_back();
  EXPECT_THROW(add(a, other_degree), Error);
  EXPECT_THROW(add(a, other_channels), Error);
  EXPECT_THROW(blend(a, other_degree, 0.5), Error);
  EXPECT_THROW(inner_product(a, other_channels), Error);
  EXPECT_THROW(scale(damaged, 2), Error);
  EXPECT_THROW(scale(empty, 2), Error);
  EXPECT_THROW(scale(a, std::vector<double>{1, 2}), Error);
  EXPECT_THROW(resize(a, -1), Error);
}

}  // namespace
}  // namespace welkin
