#include <welkin/brdf/dfg.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/brdf/ggx.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// The oracle, in other variables than the code under test: the mean of (1, (1 - v.h)^5) G2 / G1 over the sampler's unit
// square, where the visible normals are uniform. u1 = 1 - s^3 crowds the grid where normals lean far over (u1 near 1:
// the lights that fall below the horizon, a jump that costs a grid of n^2 points about n^-3/2).
DfgValue grid_oracle(double cos_view, double alpha, int n) {
  const LocalVec view{std::sqrt((1 - cos_view) * (1 + cos_view)), 0, cos_view};
  double all = 0, schlick = 0;
  for (int i = 0; i < n; ++i) {
    const double s = (i + 0.5) / n;
    for (int j = 0; j < n; ++j) {
      const LocalVec h = sample_ggx_visible_normal(view, alpha, 1 - s * s * s, (j + 0.5) / n);
      const double cos_light = reflected(view, h).z;
      const double ratio = ggx_masking_shadowing(cos_view, cos_light, alpha) / ggx_masking(cos_view, alpha);
      const double weight = 3 * s * s * ratio / (static_cast<double>(n) * n);
      all += weight;
      schlick += weight * fresnel_schlick(dot(view, h), 0);
    }
  }
  return {all - schlick, schlick};
}

TEST(Dfg, MatchesAGridOverTheVisibleNormals) {
  for (double alpha : {1e-5, 1e-3, 0.02, 0.1, 0.3, 0.6, 1.0})
    for (double cos_view : {0.002, 0.02, 0.1, 0.3, 0.7, 0.99}) {
      const DfgValue value = integrate_dfg(cos_view, alpha);
      const DfgValue truth = grid_oracle(cos_view, alpha, 500);
      // 500^-3/2 = 9e-5 is the worst case of the grid, not of the quadrature.
      EXPECT_NEAR(value.scale, truth.scale, 3e-5) << "alpha " << alpha << " cos_view " << cos_view;
      EXPECT_NEAR(value.bias, truth.bias, 3e-5) << "alpha " << alpha << " cos_view " << cos_view;
    }
}

// alpha = 1, normal incidence: D = 1 / pi and S(l) = 1. With c = cos t_h = v.h, light.z =: l = 2 c^2 - 1 and
// G2 = 2 l / (1 + l) = l / c^2, so E = 2 integral of (l / c^2) c dc = 2 integral of (2 c - 1 / c) dc
// = 2 [c^2 - ln c] from sqrt(1/2) to 1 = 1 - ln 2.
TEST(Dfg, HasTheClosedFormAtNormalIncidenceAndFullWidth) {
  // 1e-6: float in the inner loops.
  EXPECT_NEAR(integrate_dfg(1, 1).albedo(), 1 - std::numbers::ln2, 1e-6);
}

// A mirror is Schlick's term itself.
TEST(Dfg, TendsToSchlickForAMirror) {
  for (double c : {0.01, 0.3, 1.0}) {
    const double schlick = std::pow(1 - c, 5);
    EXPECT_DOUBLE_EQ(integrate_dfg(c, 0).bias, schlick);
    // alpha = 1e-6 differs from the mirror by O(alpha / c) and by the quadrature's 1e-5.
    EXPECT_NEAR(integrate_dfg(c, 1e-6).bias, schlick, 2e-4);
    EXPECT_NEAR(integrate_dfg(c, 1e-6).albedo(), 1, 2e-4);
  }
}

TEST(Dfg, NeverReflectsMoreThanItReceives) {
  for (double alpha = 1e-6; alpha <= 1; alpha *= 1.7)
    for (double c = 0; c <= 1; c += 1.0 / 64) {
      const DfgValue value = integrate_dfg(c, alpha);
      EXPECT_LE(value.albedo(), 1 + 1e-5);  // the stated error
      EXPECT_GT(value.albedo(), 0.3);       // the least is 1 - ln 2 = 0.307
      EXPECT_GE(value.scale, -1e-5);
      EXPECT_GE(value.bias, 0);
    }
}

TEST(Dfg, TableHoldsTheIntegralAtTexelCentres) {
  const DfgTable table = make_dfg_table({.size = 16});
  ASSERT_EQ(table.scale_bias.size(), 512u);
  for (int j = 0; j < 16; ++j)
    for (int i = 0; i < 16; ++i) {
      const double r = (j + 0.5) / 16, c = (i + 0.5) / 16;
      const DfgValue truth = integrate_dfg(c, r * r);
      EXPECT_FLOAT_EQ(table.scale_bias[2 * (16 * j + i)], static_cast<float>(truth.scale));
      EXPECT_FLOAT_EQ(table.scale_bias[2 * (16 * j + i) + 1], static_cast<float>(truth.bias));
      EXPECT_NEAR(look_up_dfg(table, c, r).scale, truth.scale, 1e-6);
    }
  // Beyond the outer centres the edge continues; half way it is the mean.
  EXPECT_EQ(look_up_dfg(table, 0, 0).bias, table.scale_bias[1]);
  EXPECT_NEAR(look_up_dfg(table, 1.0 / 16, 0).bias, (table.scale_bias[1] + table.scale_bias[3]) / 2, 1e-7);
}

TEST(Dfg, TableIsTheSameOnAnyNumberOfThreads) {
  set_thread_count(1);
  const DfgTable one = make_dfg_table({.size = 24});
  set_thread_count(8);
  EXPECT_EQ(make_dfg_table({.size = 24}).scale_bias, one.scale_bias);
  set_thread_count(0);
}

TEST(Dfg, RefusesSizesOutOfRange) {
  EXPECT_THROW(make_dfg_table({.size = 0}), Error);
  EXPECT_THROW(make_dfg_table({.size = 100'000}), Error);
}

// White furnace: single scattering plus the reciprocal lobe, integrated over all lights, gives 1:
// E(v) + integral of lobe cos dl = E(v) + (1 - E(v)) (1 - E_avg) / (1 - E_avg). The lobe's integral is done here.
TEST(MultipleScattering, WhiteMetalInAWhiteFurnaceReflectsEverything) {
  const QuadratureRule rule = gauss_legendre(64);
  for (double alpha : {0.05, 0.3, 0.7, 1.0}) {
    const double average = average_albedo(alpha);
    for (double cos_view : {0.05, 0.5, 1.0}) {
      const double albedo = integrate_dfg(cos_view, alpha).albedo();
      double returned = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double x = (1 + rule.nodes[i]) / 2, c = x * x;  // more nodes at grazing angles
        returned += rule.weights[i] * x * 2 * pi * c *
                    multiple_scattering_lobe(albedo, integrate_dfg(c, alpha).albedo(), average);
      }
      // 1e-5 of E over 1 - E_avg (0.003 at alpha = 0.05) times 1 - E.
      EXPECT_NEAR(albedo + returned, 1, 2e-4) << alpha << " " << cos_view;
      EXPECT_NEAR(albedo * multiple_scattering_factor(1, albedo), 1, 1e-15);
    }
  }
  EXPECT_EQ(multiple_scattering_factor(0, 0.5), 1);
}

TEST(MultipleScattering, TableWithItIsExactForGlassAndForWhiteMetal) {
  const DfgTable plain = make_dfg_table({.size = 12});
  const DfgTable baked = make_dfg_table({.size = 12, .form = DfgForm::scale_bias_with_multiple_scattering});
  double worst_between = 0;
  for (std::size_t i = 0; i < plain.scale_bias.size(); i += 2) {
    const double scale = plain.scale_bias[i], bias = plain.scale_bias[i + 1];
    const auto compensated = [&](double f0) {
      return (f0 * scale + bias) * multiple_scattering_factor(f0, scale + bias);
    };
    const auto line = [&](double f0) { return f0 * baked.scale_bias[i] + baked.scale_bias[i + 1]; };
    EXPECT_NEAR(line(0.04), compensated(0.04), 1e-6);  // float
    EXPECT_NEAR(line(1), 1, 1e-6);
    for (double f0 = 0.04; f0 < 1; f0 += 0.04)
      worst_between = std::max(worst_between, line(f0) - compensated(f0));
  }
  EXPECT_GT(worst_between, 0.05);
  EXPECT_LT(worst_between, 0.18);  // what the header promises
}

}  // namespace
}  // namespace welkin
