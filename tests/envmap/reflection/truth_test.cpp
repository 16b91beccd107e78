#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tests/envmap/maps.h>
#include <welkin/brdf/dfg.h>
#include <welkin/brdf/ggx.h>
#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/reflection/truth.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

IsotropicBrdf ggx_white(double alpha) {
  const auto value = [alpha](double cos_light, double cos_view, double azimuth) {
    const double sl = std::sqrt(1 - cos_light * cos_light), sv = std::sqrt(1 - cos_view * cos_view);
    const double cos_between = cos_light * cos_view + sl * sv * std::cos(azimuth);
    const double cos_half = (cos_light + cos_view) / std::sqrt(std::max(1e-300, 2 + 2 * cos_between));
    const double f =
        ggx_distribution(std::min(1.0, cos_half), alpha) * ggx_visibility(cos_view, cos_light, alpha);
    return std::array<double, 3>{f, 0.5 * f, 0};
  };
  return {"ggx", value, alpha};
}

TEST(ReflectionTruth, LambertIsTheIrradianceOverPi) {
  const Image map = sun_map(64, 32, 5000);
  const auto queries = random_reflection_queries(40, 3);
  const IsotropicBrdf lambert{"lambert",
                              [](double, double, double) {
                                return std::array{1 / pi, 1 / pi, 1 / pi};
                              },
                              1};
  const auto reflected = reflect_brute_force(map, lambert, queries);
  std::vector<Vec3> normals;
  for (const ReflectionQuery& query : queries) normals.push_back(query.normal);
  const ZonalKernel kernel = make_lambert_kernel();
  const auto truth = filter_brute_force(map, normals, std::span(&kernel, 1));
  // The sun lies across some horizons (16 x 16 nodes over a kink: 1e-3 of a term that is itself small there); other
  // texels across the horizon count little.
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(reflected[i], truth[i], 1e-4 * truth[i] + 1e-4);
}

TEST(ReflectionTruth, AWhiteSkyGivesTheDirectionalAlbedo) {
  const Image map = constant_map(96, 48, 2);
  for (double alpha : {0.04, 0.3, 1.0}) {
    for (double cos_view : {0.1, 0.5, 1.0}) {
      const ReflectionQuery query{
          {0.6, 0, 0.8},
          normalized(cos_view * Vec3{0.6, 0, 0.8} + std::sqrt(1 - cos_view * cos_view) * Vec3{0, 1, 0})};
      const auto reflected = reflect_brute_force(map, ggx_white(alpha), std::span(&query, 1));
      const double albedo = integrate_dfg(cos_view, alpha).albedo();
      // 1e-3 of error asked of each texel of average brightness at most (the lobe is as wide as one texel at 0.04).
      EXPECT_NEAR(reflected[0], 2 * albedo, 1e-3 * albedo) << alpha << " " << cos_view;
      EXPECT_NEAR(reflected[1], albedo, 1e-3 * albedo);
      EXPECT_EQ(reflected[2], 0);
    }
  }
}

TEST(ReflectionTruth, ALobeAboutTheMirrorDirectionIsItsConvolution) {
  const Image map = sun_map(64, 32, 5000);
  const ZonalKernel kernel = make_gaussian_kernel(0.06);
  const auto value = [&](double cos_light, double cos_view, double azimuth) {
    const double sl = std::sqrt(1 - cos_light * cos_light), sv = std::sqrt(1 - cos_view * cos_view);
    // About the mirror direction the azimuth is off by pi: 1 - cos of the angle, without cancellation.
    const double s = std::sin(0.5 * (std::acos(cos_light) - std::acos(cos_view))),
                 c = std::cos(0.5 * azimuth);
    const double f = evaluate(kernel, 2 * s * s + 2 * sl * sv * c * c) / cos_light;
    return std::array{f, f, f};
  };
  const auto queries = random_reflection_queries(30, 4, 0.4);  // the lobe ends 6 sigma before the horizon
  const auto reflected = reflect_brute_force(map, {"gaussian", value, 0.06}, queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Vec3 n = queries[i].normal, v = queries[i].view, mirror = 2 * dot(n, v) * n - v;
    const auto truth = filter_brute_force(map, std::span(&mirror, 1), std::span(&kernel, 1));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(reflected[3 * i + c], truth[c], 1e-3 * truth[c]);
  }
}

TEST(ReflectionTruth, NothingIsSeenFromBelow) {
  const ReflectionQuery below{{0, 1, 0}, normalized(Vec3{1, -0.1, 0})};
  const auto reflected = reflect_brute_force(constant_map(16, 8, 1), ggx_white(0.5), std::span(&below, 1));
  EXPECT_EQ(reflected, std::vector<double>(3, 0.0));
}

TEST(ReflectionTruth, QueriesCoverNormalsAndViewsEvenly) {
  const auto queries = random_reflection_queries(20000, 1, 0.2);
  Vec3 mean{};
  double mean_cos = 0, smallest = 1;
  for (const ReflectionQuery& query : queries) {
    const double cos_view = dot(query.normal, query.view);
    mean = mean + (1.0 / 20000) * query.normal;
    mean_cos += cos_view / 20000;
    smallest = std::min(smallest, cos_view);
    ASSERT_NEAR(length(query.normal), 1, 1e-12);
    ASSERT_NEAR(length(query.view), 1, 1e-12);
  }
  EXPECT_LT(length(mean), 0.02);       // four standard deviations: 4 / sqrt(3 * 20000)
  EXPECT_NEAR(mean_cos, 0.6, 0.0066);  // 4 * 0.8 / sqrt(12 * 20000)
  EXPECT_GE(smallest, 0.2 - 1e-12);
  EXPECT_LT(smallest, 0.201);
}

TEST(ReflectionTruth, ASpherePictureShowsTheNearSide) {
  const auto queries = sphere_picture_queries(9);
  EXPECT_NEAR(queries[40].normal.z, 1, 1e-12);  // the middle faces the camera
  EXPECT_EQ(length(queries[0].normal), 0);      // the corner lies outside
  EXPECT_GT(queries[9 * 4 + 8].normal.x, 0.8);  // right is +X
  EXPECT_GT(queries[4].normal.y, 0.8);          // up is +Y
  EXPECT_EQ(queries[17].view.z, 1);
}

}  // namespace
}  // namespace welkin
