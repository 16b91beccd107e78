#include <welkin/envmap/light_fit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "maps.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

double luminance_of(const double* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

struct Measured {
  double rms = 0, max = 0, largest = 0;
};

// Error of the fit's irradiance in luminance, against the integral over every texel.
Measured measure(const Image& map, const LightFit& fit) {
  const std::vector<Vec3> normals = sphere_points(400);
  const ZonalKernel kernel = make_lambert_kernel();
  const std::vector<double> truth = filter_brute_force(map, normals, {&kernel, 1});
  const ShCoefficients rest = convolve(fit.rest, cosine_lobe(2));
  Measured m;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    std::array<double, 3> e{};
    evaluate(rest, normals[i], e);
    for (const DirectionalLight& light : fit.lights) {
      const auto part = directional_irradiance(light, normals[i]);
      for (int c = 0; c < 3; ++c) e[c] += part[c];
    }
    const double exact = std::numbers::pi * luminance_of(&truth[3 * i]);
    const double error = std::abs(luminance_of(e.data()) - exact);
    m.largest = std::max(m.largest, exact);
    m.max = std::max(m.max, error);
    m.rms += error * error / static_cast<double>(normals.size());
  }
  m.rms = std::sqrt(m.rms);
  return m;
}

TEST(LightFit, OneLitTexelIsOneLightAndNothingElse) {
  Image map(256, 128);
  const float radiance[3] = {300, 200, 100};
  std::copy(radiance, radiance + 3, map.at(70, 40));
  const LightFit fit = fit_lights(map);
  ASSERT_EQ(fit.lights.size(), 1u);
  const double omega = equirect_texel_solid_angle(256, 128, 40);
  const Vec3 centre = equirect_direction({70.5 / 256, 40.5 / 128});
  // The search stops at steps of 1e-4 rad; degrees above 40 and the texel's extent are small beside 1e-3.
  EXPECT_NEAR(dot(fit.lights[0].direction, centre), 1, 1e-6);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(fit.lights[0].irradiance[c], radiance[c] * omega, 2e-3 * radiance[c] * omega);
  for (double v : fit.rest.values) EXPECT_NEAR(v, 0, 1e-3 * radiance[0] * omega);
}

// What nine coefficients miss is the same for a light and for its mirror image behind the sphere.
TEST(LightFit, LightsStandOnTheSideOfTheSource) {
  for (Vec3 source : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0.6, -0.64, 0.48}, Vec3{-0.6, 0.64, -0.48}}) {
    Image map(128, 64);
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 128; ++x) {
        const Vec3 d = equirect_direction({(x + 0.5) / 128, (y + 0.5) / 64});
        std::fill_n(map.at(x, y), 3, dot(d, source) > 0.99 ? 1e3f : 0.1f);
      }
    const LightFit fit = fit_lights(map, 3);
    ASSERT_FALSE(fit.lights.empty());
    // The source is a disc of 8 degrees; lights beside it make up for its extent.
    for (const DirectionalLight& light : fit.lights) EXPECT_GT(dot(light.direction, source), 0.9);
    const Measured measured = measure(map, fit);
    EXPECT_NEAR(measured.rms, fit.error, 0.2 * fit.error + 1e-5 * measured.largest);
  }
}

TEST(LightFit, PredictsTheErrorThatIsMeasured) {
  for (double elevation : {5.0, 30.0}) {
    SkyOptions sky;
    sky.elevation = elevation;
    sky.width = 256, sky.height = 128;
    const Image map = make_sky(sky);
    const LightFit one = fit_lights(map, 1), two = fit_lights(map, 2);
    const Measured m1 = measure(map, one), m2 = measure(map, two);
    // Degrees beyond 40 and 400 directions: a tenth.
    EXPECT_NEAR(one.error, m1.rms, 0.1 * m1.rms);
    EXPECT_NEAR(two.error, m2.rms, 0.1 * m2.rms);
    EXPECT_LT(two.error, one.error);
    EXPECT_LT(one.error, 0.1 * one.error_before);
    EXPECT_LT(m2.max, 0.005 * m2.largest) << "nine coefficients and two lights, sun at " << elevation;
  }
}

TEST(LightFit, LightsAreNeverNegative) {
  const Image map = noise_map(128, 64, 9);
  const LightFit fit = fit_lights(map, 5);
  for (const DirectionalLight& light : fit.lights)
    for (double e : light.irradiance) EXPECT_GE(e, 0);
  EXPECT_LE(fit.error, fit.error_before);
  const Measured m = measure(map, fit);
  EXPECT_NEAR(fit.error, m.rms, 0.1 * m.rms);
}

// Red about green: the best weight of a light is negative in one channel, so that it is left out there.
TEST(LightFit, TheErrorIsThatOfTheLightsAlsoWhereAChannelHasNone) {
  Image map(128, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const double away = std::acos(equirect_direction({(x + 0.5) / 128, (y + 0.5) / 64}).x);
      map.at(x, y)[0] = away < 0.3 ? 0 : 10;
      map.at(x, y)[1] = away < 0.3 ? 10 : 0;
    }
  const LightFit fit = fit_lights(map, 2);
  const Measured m = measure(map, fit);
  EXPECT_NEAR(fit.error, m.rms, 0.1 * m.rms);  // degrees beyond 40 and 400 directions
}

TEST(LightFit, AConstantNeedsNone) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{1, 5}, std::pair{32, 16}}) {
    const LightFit fit = fit_lights(constant_map(width, height, 2), 3);
    EXPECT_TRUE(fit.lights.empty()) << width << " x " << height;
    EXPECT_LT(fit.error, 1e-6);  // float rounding of an irradiance of 2 pi
  }
  EXPECT_TRUE(fit_lights(Image(16, 8), 2).lights.empty());  // black
}

TEST(LightFit, OptionsOutOfRangeAreErrors) {
  EXPECT_THROW(fit_lights(constant_map(8, 4, 1), 0), Error);
  EXPECT_THROW(fit_lights(constant_map(8, 4, 1), 9), Error);
}

}  // namespace
}  // namespace welkin
