#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/envmap/maps.h>
#include <welkin/envmap/reflection/fresnel_blend.h>
#include <welkin/error.h>

namespace welkin {
namespace {

FresnelBlendMaterial glass_on_colour(double exponent) {
  FresnelBlendMaterial material;
  material.albedo = {0.8, 0.5, 0.2};
  material.exponent = exponent;
  material.fresnel.kind = FresnelLaw::Kind::dielectric;
  return material;
}

TEST(FresnelLaw, HasTheKnownValues) {
  FresnelLaw law;
  EXPECT_NEAR(reflectance(law, 1)[0], 0.04, 1e-12);  // the default f0
  EXPECT_NEAR(reflectance(law, 0)[1], 1, 1e-12);
  law.kind = FresnelLaw::Kind::dielectric;
  law.eta = {1.5, 2, 3};
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(reflectance(law, 1)[c], std::pow((law.eta[c] - 1) / (law.eta[c] + 1), 2), 1e-12);
  law.kind = FresnelLaw::Kind::conductor;
  law.eta = {0.2, 0.4, 1.4};
  law.k = {3.9, 2.4, 1.6};
  for (int c = 0; c < 3; ++c) {  // ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2)
    const double k2 = law.k[c] * law.k[c];
    EXPECT_NEAR(reflectance(law, 1)[c],
                (std::pow(law.eta[c] - 1, 2) + k2) / (std::pow(law.eta[c] + 1, 2) + k2), 1e-12);
  }
}

TEST(FresnelBlend, OfAConstantEnvironmentKeepsAWhiteBaseWhite) {
  FresnelBlendMaterial material = glass_on_colour(20);
  const FresnelBlend surface = prepare_fresnel_blend(constant_map(32, 16, 3), material, {8, 16, {}});
  for (double cos_view : {1e-6, 0.2, 1.0}) {
    const ReflectionQuery query{{0, 0, 1}, {std::sqrt(1 - cos_view * cos_view), 0, cos_view}};
    const std::array<double, 3> rgb = reflect(surface, query), f = reflectance(material.fresnel, cos_view);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(rgb[c], 3 * ((1 - f[c]) * material.albedo[c] + f[c]), 3e-6);  // floats of 3
  }
}

// Where the lobe is narrow and clear of the horizon, F is constant over it, and only the diffuse part, whose F varies
// with the light, is off.
TEST(FresnelBlend, OfABlackBaseIsTheIntegral) {
  FresnelBlendMaterial material = glass_on_colour(400);
  material.albedo = {};
  const Image map = noise_map(32, 16, 3);
  const FresnelBlend surface = prepare_fresnel_blend(map, material, {8, 128, {}});
  const auto queries = random_reflection_queries(40, 2, 0.5);
  const auto truth = reflect_brute_force(map, make_fresnel_blend_brdf(material), queries);
  double error = 0, total = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      error += std::abs(reflect(surface, queries[i])[c] - truth[3 * i + c]);
      total += truth[3 * i + c];
    }
  EXPECT_LT(error / total,
            0.01);  // F varies by a few per cent over a lobe of 3 degrees at cos 0.5: 0.003 seen
  EXPECT_GT(total, 0);
}

TEST(FresnelBlend, ErrorOverAllViewAnglesIsSmall) {
  const Image map = sun_map(32, 16, 60);
  const auto queries = random_reflection_queries(60, 4, 0.0);
  for (double exponent : {10.0, 100.0}) {
    const FresnelBlendMaterial material = glass_on_colour(exponent);
    const FresnelBlend surface = prepare_fresnel_blend(map, material, {32, 64, {}});
    const auto truth = reflect_brute_force(map, make_fresnel_blend_brdf(material), queries);
    double error = 0, total = 0;
    for (std::size_t i = 0; i < queries.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        error += std::abs(reflect(surface, queries[i])[c] - truth[3 * i + c]);
        total += truth[3 * i + c];
      }
    EXPECT_LT(error / total, 0.15) << exponent;  // light below the horizon, F outside the integral
    EXPECT_GT(error / total, 0.001) << exponent;
  }
}

TEST(FresnelBlend, BadParametersAreRefused) {
  const Image map = constant_map(8, 4, 1);
  FresnelBlendMaterial material;
  material.albedo[1] = 1.5;
  EXPECT_THROW(prepare_fresnel_blend(map, material), Error);
  material = {};
  material.exponent = -1;
  EXPECT_THROW(make_fresnel_blend_brdf(material), Error);
  material = {};
  material.fresnel.eta[0] = 0;
  EXPECT_THROW(make_fresnel_blend_brdf(material), Error);
  EXPECT_THROW(prepare_fresnel_blend(map, {}, {0, 16, {}}), Error);
}

}  // namespace
}  // namespace welkin
