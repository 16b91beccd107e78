#include <welkin/envmap/sh_filter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/rotation.h>

namespace welkin {
namespace {

// The definition: integral of K(angle to the direction) f, in the direction +z after a rotation that brings it there.
// Only the zonal part of f survives the azimuth integral, the rest is Gauss-Legendre on [0, 1] in cos theta.
double filtered(const ShCoefficients& f, const ZonalKernel& kernel, const Mat3& to_pole) {
  const ShCoefficients turned = rotate(f, to_pole);
  const QuadratureRule rule = gauss_legendre(200);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double x = (1 + rule.nodes[i]) / 2;
    double value = 0;
    for (int l = 0; l <= f.max_degree; ++l)
      value += turned.values[sh_index(l, 0)] * std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) *
               std::legendre(static_cast<unsigned>(l), x);
    sum += std::numbers::pi * rule.weights[i] * evaluate(kernel, 1 - x) * value;
  }
  return sum;
}

TEST(ShFilter, IsTheIntegralOverTheKernel) {
  std::mt19937 random(1);
  const ShCoefficients f = random_coefficients(10, 1, random);
  for (const ZonalKernel& kernel : {make_ggx_kernel(0.5), make_phong_kernel(20), make_lambert_kernel()}) {
    const Mat3 to_pole = random_rotation(random);
    EXPECT_NEAR(value_in(convolve(f, kernel), to_pole.rows[2])[0], filtered(f, kernel, to_pole), 1e-10)
        << describe(kernel);  // the accuracy of the kernels' coefficients
  }
}

TEST(ShFilter, LambertGivesIrradianceOverPi) {
  std::mt19937 random(2);
  const ShCoefficients f = random_coefficients(5, 3, random);
  ShCoefficients irradiance = convolve(f, cosine_lobe(5));
  for (double& value : irradiance.values) value /= std::numbers::pi;
  EXPECT_LT(largest_difference(convolve(f, make_lambert_kernel()).values, irradiance.values), 1e-10);
}

TEST(ShFilter, RefusesMalformedCoefficients) {
  EXPECT_THROW(convolve(ShCoefficients{}, make_lambert_kernel()), Error);
}

}  // namespace
}  // namespace welkin
