#include <welkin/sh/product.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/algebra.h>

namespace welkin {
namespace {

// The brute force: integral of value(direction) by 40 x 83 points, exact to degree 79.
template <class Value>
double integral(Value&& value) {
  const QuadratureRule rule = gauss_legendre(40);
  constexpr int azimuths = 83;
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    for (int k = 0; k < azimuths; ++k) {
      const double phi = 2 * std::numbers::pi * (k + 0.3) / azimuths;
      const double r = std::sqrt(1 - rule.nodes[i] * rule.nodes[i]);
      sum += rule.weights[i] * 2 * std::numbers::pi / azimuths *
             value(Vec3{r * std::cos(phi), r * std::sin(phi), rule.nodes[i]});
    }
  return sum;
}

double basis_function(std::size_t index, Vec3 direction) {
  std::vector<double> y(sh_count(4));
  evaluate_sh_basis(direction, 4, y);
  return y[index];
}

// z z = 1/3 + (z^2 - 1/3): with Y_10 = sqrt(3/4pi) z the product Y_10 Y_10 is Y_00/sqrt(4pi) + Y_20/sqrt(5pi).
TEST(ShProduct, OfTwoLinearFunctionsIsWrittenOut) {
  ShCoefficients z(1, 1);
  z.values[sh_index(1, 0)] = 1;
  const ShCoefficients square = product(z, z);
  ASSERT_EQ(square.max_degree, 2);
  for (std::size_t i = 0; i < 9; ++i) {
    const double expected = i == 0                ? 1 / std::sqrt(4 * std::numbers::pi)
                            : i == sh_index(2, 0) ? 1 / std::sqrt(5 * std::numbers::pi)
                                                  : 0;
    EXPECT_NEAR(square.values[i], expected, 1e-14) << i;  // rounding
  }
}

TEST(ShProduct, HasTheValuesOfThePointwiseProduct) {
  std::mt19937 random(1);
  for (auto [a, b] : {std::pair{0, 0}, {0, 3}, {2, 2}, {5, 1}, {7, 9}, {20, 13}}) {
    const ShCoefficients f = random_coefficients(a, 2, random), g = random_coefficients(b, 2, random);
    const ShCoefficients fg = product(f, g);
    ASSERT_EQ(fg.max_degree, a + b);
    for (int i = 0; i < 5; ++i) {
      const Vec3 d = random_unit_vector(random);
      for (int c = 0; c < 2; ++c)
        EXPECT_NEAR(value_in(fg, d)[c], value_in(f, d)[c] * value_in(g, d)[c],
                    1e-11);  // rounding of ~1000 terms
    }
  }
}

TEST(ShProduct, CutToADegreeKeepsTheExactCoefficients) {
  std::mt19937 random(2);
  const ShCoefficients f = random_coefficients(6, 3, random), g = random_coefficients(4, 3, random);
  const ShCoefficients full = product(f, g);
  for (int degree : {0, 3, 10, 12})
    EXPECT_LT(largest_difference(product(f, g, degree).values, resize(full, degree).values), 1e-13) << degree;
}

TEST(ShProduct, TripleProductIsTheIntegral) {
  std::mt19937 random(3);
  const ShCoefficients f = random_coefficients(6, 1, random), g = random_coefficients(4, 1, random),
                       h = random_coefficients(9, 1, random);
  const double expected =
      integral([&](Vec3 d) { return value_in(f, d)[0] * value_in(g, d)[0] * value_in(h, d)[0]; });
  EXPECT_NEAR(triple_product(f, g, h)[0], expected, 1e-11);  // rounding of 3320 points
  EXPECT_NEAR(triple_product(h, f, g)[0], expected, 1e-11);
}

// Every triple of the table, and every one that it leaves out, against the brute integral.
TEST(ShProduct, TableHoldsAllTripleProductsThatAreNotZero) {
  const TripleProductTable table = make_triple_product_table(2);
  std::vector<double> dense(9 * 9 * 9);
  std::size_t not_zero = 0;
  for (const auto& e : table.entries) {
    ASSERT_LE(e.i, e.j);
    EXPECT_NE(e.value, 0);
    dense[(e.i * 9 + e.j) * 9 + e.k] = e.value;
  }
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t j = i; j < 9; ++j)
      for (std::size_t k = 0; k < 9; ++k) {
        const double expected = integral(
            [&](Vec3 d) { return basis_function(i, d) * basis_function(j, d) * basis_function(k, d); });
        not_zero += std::abs(expected) > 1e-10;
        EXPECT_NEAR(dense[(i * 9 + j) * 9 + k], expected, 1e-13) << i << " " << j << " " << k;
      }
  EXPECT_EQ(table.entries.size(), not_zero);
  EXPECT_EQ(not_zero, 52u);  // of 405
}

TEST(ShProduct, ByTheTableEqualsByQuadrature) {
  std::mt19937 random(4);
  for (int degree : {0, 1, 4, 8}) {
    const ShCoefficients f = random_coefficients(degree, 3, random),
                         g = random_coefficients(degree, 3, random);
    const ShCoefficients by_table = product(make_triple_product_table(degree), f, g);
    EXPECT_LT(largest_difference(by_table.values, product(f, g, degree).values), 1e-12);  // rounding
  }
}

TEST(ShProduct, MatrixTimesVectorIsTheProduct) {
  std::mt19937 random(5);
  for (auto [f_degree, in, out] : {std::array{3, 2, 5}, {9, 2, 3}, {0, 4, 4}, {4, 4, 4}}) {
    const ShCoefficients f = random_coefficients(f_degree, 1, random), g = random_coefficients(in, 1, random);
    const std::vector<double> matrix = product_matrix(f, in, out);
    std::vector<double> multiplied(sh_count(out));
    for (std::size_t row = 0; row < multiplied.size(); ++row)
      for (std::size_t column = 0; column < g.values.size(); ++column)
        multiplied[row] += matrix[row * g.values.size() + column] * g.values[column];
    EXPECT_LT(largest_difference(multiplied, product(f, g, out).values), 1e-12);
  }
}

TEST(ShProduct, RefusesWhatDoesNotFit) {
  const ShCoefficients a(2, 3), b(2, 1), c(3, 3), large(200, 3);
  EXPECT_THROW(product(a, b), Error);
  EXPECT_THROW(product(a, a, -1), Error);
  EXPECT_THROW(product(large, large), Error);
  EXPECT_THROW(product(ShCoefficients{}, ShCoefficients{}), Error);
  EXPECT_THROW(product(make_triple_product_table(2), a, c), Error);
  EXPECT_THROW(make_triple_product_table(13), Error);
  EXPECT_THROW(product_matrix(a, 2, 2), Error);
  EXPECT_THROW(product_matrix(b, 33, 2), Error);
}

}  // namespace
}  // namespace welkin
