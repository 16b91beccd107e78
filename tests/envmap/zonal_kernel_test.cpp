#include <welkin/envmap/zonal_kernel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// 2 pi integral of K(cos t) P_l(cos t) sin t dt in the variable u = 1 - cos t, graded towards u = 0 and u = 2: another
// variable and another rule than the code under test uses.
double integrate(const ZonalKernel& kernel, int l) {
  const QuadratureRule rule = gauss_legendre(40);
  double sum = 0;
  for (bool far : {false, true}) {
    double to = 1;
    for (int panel = 0; panel < 50; ++panel, to /= 2) {
      const double from = panel == 49 ? 0 : to / 2;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double v = 0.5 * (from + to) + 0.5 * (to - from) * rule.nodes[i], u = far ? 2 - v : v;
        sum += 0.5 * (to - from) * rule.weights[i] * 2 * pi * evaluate(kernel, u) * std::legendre(l, 1 - u);
      }
    }
  }
  return sum;
}

class ZonalKernels : public testing::TestWithParam<ZonalKernel> {};

TEST_P(ZonalKernels, IntegrateToOne) { EXPECT_NEAR(integrate(GetParam(), 0), 1, 1e-10); }

TEST_P(ZonalKernels, HaveTheCoefficientsOfTheirIntegral) {
  const auto k = legendre_coefficients(GetParam(), 64);
  EXPECT_DOUBLE_EQ(k[0], 1);
  for (int l : {1, 2, 3, 7, 20, 64}) EXPECT_NEAR(k[l], integrate(GetParam(), l), 1e-10) << "l = " << l;
}

// Core and rest share K: the rest's coefficients are those of K minus those of the core.
TEST_P(ZonalKernels, CoreAndRestMakeTheKernel) {
  const double near = 0.3;
  const auto whole = legendre_coefficients(GetParam(), 30),
             rest = legendre_coefficients_of_rest(GetParam(), near, 30);
  const QuadratureRule rule = gauss_legendre(200);
  for (int l : {0, 1, 9, 30}) {
    double core = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      // theta = near x^3 puts nodes where narrow kernels vary.
      const double x = 0.5 + 0.5 * rule.nodes[i], theta = near * x * x * x, s = std::sin(theta / 2);
      core += 0.5 * rule.weights[i] * near * 3 * x * x * 2 * pi * std::sin(theta) *
              evaluate(GetParam(), 2 * s * s) * core_share(theta / near) * std::legendre(l, std::cos(theta));
    }
    EXPECT_NEAR(rest[l] + core, whole[l], 1e-9) << "l = " << l;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ZonalKernels,
                         testing::Values(make_ggx_kernel(0.01), make_ggx_kernel(0.25), make_ggx_kernel(1),
                                         make_phong_kernel(0), make_phong_kernel(1), make_phong_kernel(500),
                                         make_lambert_kernel(), make_gaussian_kernel(0.05),
                                         make_gaussian_kernel(1.2), make_blinn_phong_kernel(0),
                                         make_blinn_phong_kernel(300), make_von_mises_fisher_kernel(0),
                                         make_von_mises_fisher_kernel(2), make_von_mises_fisher_kernel(900)),
                         [](const auto& param) {
                           std::string text = describe(param.param);
                           for (char& c : text)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return text;
                         });

// alpha = 1 makes D constant, so only the cosine is left.
TEST(ZonalKernel, GgxOfAlphaOneIsLambert) {
  for (double u : {0.0, 0.3, 0.99, 1.5})
    EXPECT_NEAR(evaluate(make_ggx_kernel(1), u), evaluate(make_lambert_kernel(), u), 1e-12);
}

TEST(ZonalKernel, BlinnPhongOfExponentZeroIsLambert) {
  for (double u : {0.0, 0.3, 0.99, 1.5})
    EXPECT_NEAR(evaluate(make_blinn_phong_kernel(0), u), evaluate(make_lambert_kernel(), u), 1e-12);
}

// k_1 of the von Mises-Fisher distribution is its mean cosine, coth kappa - 1/kappa (Fisher 1953).
TEST(ZonalKernel, VonMisesFisherHasItsMeanCosine) {
  for (double kappa : {0.5, 3.0, 40.0})
    EXPECT_NEAR(legendre_coefficients(make_von_mises_fisher_kernel(kappa), 1)[1],
                1 / std::tanh(kappa) - 1 / kappa, 1e-12);
}

// The ratio of two values of D(theta/2, alpha) cos theta, by the formula of Walter et al. 2007, equation 33, spelled out.
TEST(ZonalKernel, GgxHasTheShapeOfItsDefinition) {
  const double alpha = 0.3;
  const auto direct = [&](double theta) {
    const double c = std::cos(theta / 2), t = std::tan(theta / 2);
    return alpha * alpha / (pi * std::pow(c, 4) * std::pow(alpha * alpha + t * t, 2)) * std::cos(theta);
  };
  const ZonalKernel kernel = make_ggx_kernel(alpha);
  for (double theta : {0.1, 0.7, 1.4})
    EXPECT_NEAR(evaluate(kernel, 1 - std::cos(theta)) / evaluate(kernel, 0), direct(theta) / direct(0),
                1e-12);
}

TEST(ZonalKernel, LambertCoefficientsAreTheCosineLobeOverPi) {
  const auto k = legendre_coefficients(make_lambert_kernel(), 12);
  const auto a = cosine_lobe(12);
  for (int l = 0; l <= 12; ++l) EXPECT_NEAR(k[l], a[l] / pi, 1e-12);
}

TEST(ZonalKernel, RefusesParametersOutOfRange) {
  EXPECT_THROW(make_ggx_kernel(0), Error);
  EXPECT_THROW(make_ggx_kernel(1.01), Error);
  EXPECT_THROW(make_ggx_kernel(NAN), Error);
  EXPECT_THROW(make_phong_kernel(-1), Error);
  EXPECT_THROW(make_gaussian_kernel(0), Error);
  EXPECT_THROW(make_blinn_phong_kernel(-0.1), Error);
  EXPECT_THROW(make_von_mises_fisher_kernel(-1), Error);
  EXPECT_THROW(make_von_mises_fisher_kernel(INFINITY), Error);
}

TEST(CoreShare, FallsSmoothlyFromOneToZero) {
  EXPECT_EQ(core_share(0), 1);
  EXPECT_EQ(core_share(1), 0);
  EXPECT_NEAR(core_share(0.5), 0.5, 1e-14);
  for (double t = 0.01; t < 1; t += 0.01) {
    EXPECT_LE(core_share(t), core_share(t - 0.01));
    EXPECT_NEAR(core_share(t) + core_share(1 - t), 1, 1e-14);
  }
  EXPECT_LT(1 - core_share(0.05), 1e-6);  // 6435 t^8 to leading order
}

}  // namespace
}  // namespace welkin
