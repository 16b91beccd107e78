#include <welkin/sh/irradiance_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <welkin/error.h>
#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

ShCoefficients random_coefficients(int degree, int channels, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  ShCoefficients f(degree, channels);
  for (double& v : f.values) v = normal(random);
  return f;
}

std::vector<std::array<float, 3>> random_normals(int count) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  std::vector<std::array<float, 3>> normals(count);
  for (auto& n : normals) {
    const Vec3 d = normalized({normal(random), normal(random), normal(random)});
    n = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
  }
  return normals;
}

// The published constants c1 .. c5, entry by entry, from radiance coefficients that are 1 one at a time.
TEST(IrradianceMatrix, HasThePublishedConstants) {
  const double c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708;
  ShCoefficients radiance(2, 3);
  for (int i = 0; i < 9; ++i) radiance.values[3 * i + 1] = i + 1;  // green: L_00 = 1, L_1-1 = 2, ... L_22 = 9
  const QuadraticForm m = irradiance_matrices_from_radiance(radiance)[1];
  const double expected[4][4] = {{9 * c1, 5 * c1, 8 * c1, 4 * c2},
                                 {5 * c1, -9 * c1, 6 * c1, 2 * c2},
                                 {8 * c1, 6 * c1, 7 * c3, 3 * c2},
                                 {4 * c2, 2 * c2, 3 * c2, c4 - 7 * c5}};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      EXPECT_NEAR(m[i][j], expected[i][j], 1.2e-5);  // c3 is printed 1.2e-6 off, times 9
  EXPECT_EQ(irradiance_matrices_from_radiance(radiance)[0], QuadraticForm{});
}

TEST(IrradianceMatrix, IsTheFunctionAndComesBack) {
  const ShCoefficients f = random_coefficients(2, 3, 1);
  IrradianceMatrices matrices = irradiance_matrices(f);
  for (const auto& n : random_normals(200)) {
    const Vec3 d = normalized({n[0], n[1], n[2]});
    double expected[3];
    evaluate(f, d, expected);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(evaluate(matrices[c], d), expected[c], 1e-14);
  }
  const auto expect_same = [&] {
    const ShCoefficients back = irradiance_from_matrices(matrices);
    for (std::size_t i = 0; i < f.values.size(); ++i) EXPECT_NEAR(back.values[i], f.values[i], 1e-12);
  };
  expect_same();
  for (int i = 0; i < 4; ++i) matrices[0][i][i] += i < 3 ? 0.7 : -0.7;  // another split of the constant
  expect_same();
}

TEST(IrradianceMatrix, OfWhiteLightIsPi) {
  ShCoefficients radiance(2, 3);
  for (int c = 0; c < 3; ++c) radiance.values[c] = std::sqrt(4 * std::acos(-1.0));
  const IrradianceMatrices m = irradiance_matrices_from_radiance(radiance);
  EXPECT_NEAR(evaluate(m[2], normalized({1, 2, 3})), std::acos(-1.0), 1e-15 * 4);
}

TEST(IrradianceMatrix, VerticesEqualEvaluate) {
  const ShCoefficients f = random_coefficients(2, 3, 2);
  const IrradianceMatrices matrices = irradiance_matrices(f);
  for (int count : {0, 1, 15, 16, 17, 1000}) {
    const auto normals = random_normals(count);
    std::vector<std::array<float, 3>> fast(count), scalar(count);
    irradiance_of_normals(matrices, normals, fast);
    irradiance_of_normals_scalar(matrices, normals, scalar);
    for (int i = 0; i < count; ++i) {
      double expected[3];
      evaluate(f, normalized({normals[i][0], normals[i][1], normals[i][2]}), expected);
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(fast[i][c], expected[c], 2e-6);   // floats of values of a few units
        ASSERT_NEAR(fast[i][c], scalar[i][c], 1e-6);  // fused products round once less
      }
    }
  }
}

TEST(IrradianceMatrix, RefusesOtherDegreesAndChannels) {
  EXPECT_THROW(irradiance_matrices(ShCoefficients(3, 3)), Error);
  EXPECT_THROW(irradiance_matrices(ShCoefficients(1, 3)), Error);
  EXPECT_THROW(irradiance_matrices(ShCoefficients(2, 1)), Error);
  EXPECT_THROW(irradiance_matrices_from_radiance(ShCoefficients(2, 4)), Error);
}

}  // namespace
}  // namespace welkin
