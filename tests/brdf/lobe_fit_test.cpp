#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/brdf/dfg.h>
#include <welkin/brdf/lobe_fit.h>
#include <welkin/brdf/models.h>
#include <welkin/error.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// A fit finds axes to a hundredth of the angular width, which is a thousandth of the lobe's shape at most.
constexpr double shape_tolerance = 2e-3;

TEST(LobeFit, ABrdfThatIsALobeIsFittedExactly) {
  const IsotropicBrdf phong = make_phong_brdf(50);
  const std::vector<double> views{0, 0.5, 1.0, 1.4};
  const double energy = 52 / 51.0;  // (N + 2) / (2 pi) times the integral of cos^N, 2 pi / (N + 1)
  const std::vector<double> angles = lobe_angles(phong);
  for (const LobeFit& fit : fit_lobes(phong, views, {.target = LobeTarget::brdf})) {
    EXPECT_NEAR(fit.lobes[0].axis, fit.view_angle, 0.01 * phong.angular_width);
    EXPECT_LT(fit.relative_error, shape_tolerance);
    EXPECT_NEAR(fit.lobes[0].energy[1], energy, shape_tolerance);
    for (std::size_t k = 0; k < angles.size() && angles[k] < pi / 2 - fit.view_angle; ++k) {
      const double truth = 51 / (2 * pi) * std::pow(std::cos(angles[k]), 50);
      EXPECT_NEAR(fit.lobes[0].values[k], truth, shape_tolerance * 51 / (2 * pi));
    }
  }
  const LobeFitOptions member{.family = LobeFamily::phong, .target = LobeTarget::brdf};
  for (const LobeFit& fit : fit_lobes(phong, views, member)) {
    EXPECT_NEAR(fit.lobes[0].parameter, 50, 0.5);
    EXPECT_LT(fit.relative_error, 5 * shape_tolerance);  // N 1 % off is 0.5 % of the shape
  }
}

TEST(LobeFit, OneShapeServesAllViewsOfALobe) {
  const std::vector<double> views{0, 0.4, 0.8, 1.2};
  for (const LobeFit& fit : fit_single_lobe(make_phong_brdf(80), views, {.target = LobeTarget::brdf})) {
    EXPECT_LT(fit.relative_error, shape_tolerance);
    EXPECT_NEAR(fit.lobes[0].energy[0], 82.0 / 81, shape_tolerance);
  }
}

TEST(LobeFit, EnergiesAreTheDirectionalAlbedo) {
  const std::vector<double> views{0, 0.6, 1.0, 1.3, 1.45};
  const std::array<double, 3> f0{1, 0.5, 0.04};
  for (int lobes : {1, 2}) {
    const auto fits = fit_lobes(make_ggx_brdf(0.3, f0), views, {.lobes = lobes});
    for (const LobeFit& fit : fits) {
      const DfgValue dfg = integrate_dfg(std::cos(fit.view_angle), 0.3);
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (const FittedLobe& lobe : fit.lobes) sum += lobe.energy[c];
        EXPECT_NEAR(sum, f0[c] * dfg.scale + dfg.bias, 3e-3);  // 32 points a ring, cut by the horizon
      }
    }
  }
}

TEST(LobeFit, ShapesIntegrateToOneAndAreNotNegative) {
  const IsotropicBrdf brdf = make_ward_brdf(0.2);
  const std::vector<double> views{0.2, 1.2}, angles = lobe_angles(brdf);
  for (const LobeFit& fit : fit_lobes(brdf, views, {.lobes = 3}))
    for (const FittedLobe& lobe : fit.lobes) {
      ASSERT_EQ(lobe.values.size(), angles.size());
      double sum = 0;
      for (std::size_t k = 1; k < angles.size(); ++k)
        sum += pi * (lobe.values[k] * std::sin(angles[k]) + lobe.values[k - 1] * std::sin(angles[k - 1])) *
               (angles[k] - angles[k - 1]);
      EXPECT_NEAR(sum, 1, 0.02);  // the trapezoidal rule on the table's nodes, of spiky shapes too
      EXPECT_GE(*std::min_element(lobe.values.begin(), lobe.values.end()), 0);
    }
}

TEST(LobeFit, IsExactAtNormalViewAndMoreLobesFitBetter) {
  const std::vector<double> views{0, 0.7, 1.1, 1.35};
  const IsotropicBrdf brdf = make_ggx_brdf(0.25, {1, 1, 1});
  const auto one = fit_lobes(brdf, views), two = fit_lobes(brdf, views, {.lobes = 2});
  const auto single = fit_single_lobe(brdf, views);
  EXPECT_LT(one[0].relative_error, shape_tolerance);  // radially symmetric there
  for (std::size_t i = 1; i < views.size(); ++i) {
    EXPECT_LT(two[i].relative_error, 0.8 * one[i].relative_error);
    EXPECT_LE(one[i].relative_error,
              single[i].relative_error * 1.02);  // its own shape is the best up to the axis
  }
  EXPECT_LT(one[1].relative_error, 0.13);  // what docs/reflection.md says of 40 degrees
  for (LobeFamily family : {LobeFamily::ggx, LobeFamily::phong}) {
    const auto member = fit_lobes(brdf, views, {.family = family});
    for (std::size_t i = 0; i < views.size(); ++i)
      EXPECT_GE(member[i].relative_error * 1.02, one[i].relative_error);  // a free shape cannot be worse
  }
}

TEST(LobeFit, BadOptionsAreRefused) {
  const IsotropicBrdf brdf = make_lambert_brdf({1, 1, 1});
  const std::vector<double> good{0.5}, bad{1.6};
  EXPECT_THROW(fit_lobes(brdf, good, {.lobes = 0}), Error);
  EXPECT_THROW(fit_lobes(brdf, good, {.lobes = 5}), Error);
  EXPECT_THROW(fit_lobes(brdf, bad), Error);
  EXPECT_THROW(fit_single_lobe(brdf, good, {.lobes = 2}), Error);
}

}  // namespace
}  // namespace welkin
