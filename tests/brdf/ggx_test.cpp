#include <welkin/brdf/ggx.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

LocalVec direction(double cosine, double azimuth) {
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

// Integral over [0, 1] in t = log-like steps: c = cos t_h with tan t_h = alpha sinh t resolves any width.
template <class F>
double integrate_half_angle(double alpha, F&& f) {
  const QuadratureRule rule = gauss_legendre(200);
  const double end = std::asinh(1e9 / alpha);
  double sum = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double t = (1 + rule.nodes[i]) / 2 * end;
    const double tangent = alpha * std::sinh(t);
    const double cosine = 1 / std::sqrt(1 + tangent * tangent);
    // |d cos| = tan cos^3 d tan, d tan = alpha cosh t dt
    sum += rule.weights[i] / 2 * end * f(cosine) * tangent * std::pow(cosine, 3) * alpha * std::cosh(t);
  }
  return sum;
}

TEST(Ggx, DistributionWithTheCosineIntegratesToOne) {
  for (double alpha : {1e-4, 0.01, 0.1, 0.5, 1.0}) {
    const double total =
        integrate_half_angle(alpha, [&](double c) { return 2 * pi * ggx_distribution(c, alpha) * c; });
    // 200 Gauss nodes on a smooth integrand; cos t_h rounds 1 - c^2 to 2e-16 of 1, alpha^2 = 1e-8 at the smallest.
    EXPECT_NEAR(total, 1, 1e-7) << alpha;
  }
}

// At normal incidence D = 1 / (pi alpha^2); at alpha = 1 D is the constant 1 / pi.
TEST(Ggx, DistributionHasItsPublishedValues) {
  EXPECT_NEAR(ggx_distribution(1, 0.1), 100 / pi, 1e-12);
  EXPECT_NEAR(ggx_distribution(0.3, 1), 1 / pi, 1e-15);
  EXPECT_EQ(ggx_distribution(-0.1, 0.5), 0);
}

// Walter et al. 2007, eq. 34: G1 = 2 / (1 + sqrt(1 + alpha^2 tan^2)).
TEST(Ggx, MaskingHasTheClosedForm) {
  for (double alpha : {0.001, 0.3, 1.0})
    for (double c : {0.001, 0.1, 0.7, 0.9999}) {
      const double tan2 = 1 / (c * c) - 1;
      EXPECT_NEAR(ggx_masking(c, alpha), 2 / (1 + std::sqrt(1 + alpha * alpha * tan2)), 1e-12);
    }
  EXPECT_DOUBLE_EQ(ggx_masking(1, 0.7), 1);
  EXPECT_EQ(ggx_masking(0, 0.7), 0);
}

// Heitz 2014, eq. 14: the visible area of the facets is the projected area of the plane,
// integral of G1(view) max(0, v.h) D(h) dh = cos_view. Divided by cos_view: the density of visible normals is one.
TEST(Ggx, VisibleNormalDensityIntegratesToOne) {
  const QuadratureRule azimuths = gauss_legendre(400);
  for (double alpha : {0.01, 0.2, 1.0})
    for (double cos_view : {0.05, 0.4, 1.0}) {
      const LocalVec view = direction(cos_view, 0.4);
      const double total = integrate_half_angle(alpha, [&](double c) {
        double ring = 0;
        for (std::size_t i = 0; i < azimuths.nodes.size(); ++i)
          ring += azimuths.weights[i] * pi *
                  ggx_visible_normal_pdf(view, direction(c, pi * azimuths.nodes[i]), alpha);
        return ring;
      });
      // max(0, v.h) has a kink across the nodes: 400 nodes leave about 1e-5 of it.
      EXPECT_NEAR(total, 1, 5e-5) << alpha << " " << cos_view;
    }
}

// The sampler and its density agree: means over samples equal integrals against the density. First and second moments
// of the normal, on a regular grid of 600 x 600 random numbers.
TEST(Ggx, VisibleNormalsFollowTheirDensity) {
  const double alpha = 0.4;
  const LocalVec view = direction(0.3, 0);
  constexpr int n = 600;
  double sampled_x = 0, sampled_z = 0, sampled_yy = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const LocalVec h = sample_ggx_visible_normal(view, alpha, (i + 0.5) / n, (j + 0.5) / n);
      EXPECT_NEAR(dot(h, h), 1, 1e-12);
      EXPECT_GE(dot(h, view), -1e-9);
      sampled_x += h.x / (n * n);
      sampled_z += h.z / (n * n);
      sampled_yy += h.y * h.y / (n * n);
    }
  const auto moment = [&](auto&& g) {
    const QuadratureRule azimuths = gauss_legendre(400);
    return integrate_half_angle(alpha, [&](double c) {
      double ring = 0;
      for (std::size_t i = 0; i < azimuths.nodes.size(); ++i) {
        const LocalVec h = direction(c, pi * azimuths.nodes[i]);
        ring += azimuths.weights[i] * pi * ggx_visible_normal_pdf(view, h, alpha) * g(h);
      }
      return ring;
    });
  };
  // The grid is exact to about n^-3/2 = 7e-5 where the mapping has a square root at the rim.
  EXPECT_NEAR(sampled_x, moment([](LocalVec h) { return h.x; }), 1e-4);
  EXPECT_NEAR(sampled_z, moment([](LocalVec h) { return h.z; }), 1e-4);
  EXPECT_NEAR(sampled_yy, moment([](LocalVec h) { return h.y * h.y; }), 1e-4);
}

TEST(Ggx, ReflectionIsReciprocal) {
  for (double alpha : {0.01, 0.3, 1.0}) {
    EXPECT_DOUBLE_EQ(ggx_visibility(0.2, 0.9, alpha), ggx_visibility(0.9, 0.2, alpha));
    EXPECT_DOUBLE_EQ(ggx_masking_shadowing(0.2, 0.9, alpha), ggx_masking_shadowing(0.9, 0.2, alpha));
    EXPECT_NEAR(ggx_visibility(0.2, 0.9, alpha), ggx_masking_shadowing(0.2, 0.9, alpha) / (4 * 0.2 * 0.9),
                1e-12);
    EXPECT_GE(ggx_masking_shadowing(0.2, 0.9, alpha), ggx_masking(0.2, alpha) * ggx_masking(0.9, alpha));
    EXPECT_LE(ggx_masking_shadowing(0.2, 0.9, alpha), ggx_masking(0.2, alpha));
  }
  const LocalVec h = direction(0.8, 1), v = direction(0.5, 2);
  EXPECT_NEAR(dot(reflected(v, h), h), dot(v, h), 1e-15);
  EXPECT_NEAR(dot(reflected(reflected(v, h), h), v), 1, 1e-15);
}

TEST(Fresnel, HasItsKnownValues) {
  EXPECT_NEAR(fresnel_dielectric(1, 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_dielectric(0, 1.5), 1, 1e-15);
  EXPECT_EQ(fresnel_dielectric(0.5, 1 / 1.5), 1);  // beyond the critical angle of 41.8 degrees
  // At Brewster's angle, tan = eta, the parallel part vanishes: R = ((eta^2 - 1) / (eta^2 + 1))^2 / 2.
  EXPECT_NEAR(fresnel_dielectric(1 / std::sqrt(1 + 2.25), 1.5), std::pow(1.25 / 3.25, 2) / 2, 1e-15);
  // ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2) at normal incidence; gold near 650 nm.
  EXPECT_NEAR(fresnel_conductor(1, 0.16, 3.4), (0.84 * 0.84 + 3.4 * 3.4) / (1.16 * 1.16 + 3.4 * 3.4), 1e-14);
  EXPECT_NEAR(fresnel_conductor(0, 0.16, 3.4), 1, 1e-14);
  for (double c : {0.1, 0.5, 0.9})
    EXPECT_NEAR(fresnel_conductor(c, 1.5, 0), fresnel_dielectric(c, 1.5), 1e-14);
  EXPECT_DOUBLE_EQ(fresnel_schlick(1, 0.04), 0.04);
  EXPECT_DOUBLE_EQ(fresnel_schlick(0, 0.04), 1);
  EXPECT_DOUBLE_EQ(fresnel_schlick(0.5, 0, 1), 1.0 / 32);
}

}  // namespace
}  // namespace welkin
