#include <welkin/envmap/lights.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maps.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/sky/daylight.h>
#include <welkin/envmap/sky/sky.h>
#include <welkin/envmap/statistics.h>
#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/projection.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

constexpr double degree = std::numbers::pi / 180;

SkyOptions day(double elevation, double azimuth = 30, int height = 512) {
  SkyOptions options;
  options.elevation = elevation;
  options.azimuth = azimuth;
  options.width = 2 * height;
  options.height = height;
  return options;
}

DaylightOptions daylight(const SkyOptions& sky) { return {sky.elevation, sky.azimuth, sky.turbidity, false}; }

double angle(Vec3 a, Vec3 b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

double luminance_of(const double* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

// Luminance of the irradiance in directions, every texel integrated.
std::vector<double> irradiance(const Image& map, const std::vector<Vec3>& normals) {
  const ZonalKernel kernel = make_lambert_kernel();
  const std::vector<double> filtered = filter_brute_force(map, normals, {&kernel, 1});
  std::vector<double> out;
  for (std::size_t i = 0; i < normals.size(); ++i)
    out.push_back(std::numbers::pi * luminance_of(&filtered[3 * i]));
  return out;
}

// Normals all around, and a ring at right angles to the first light, where its cosine has its kink.
std::vector<Vec3> normals_for(const DirectionalLight& light) {
  std::vector<Vec3> normals = sphere_points(150);
  const Vec3 side = normalized(cross(light.direction, Vec3{0.3, 0.2, 0.9}));
  const Vec3 other = cross(light.direction, side);
  for (int i = 0; i < 24; ++i) {
    const double phi = 2 * std::numbers::pi * i / 24, tilt = 0.01 * (i % 3 - 1);
    normals.push_back(normalized(std::cos(phi) * side + std::sin(phi) * other + tilt * light.direction));
  }
  return normals;
}

class SunAt : public testing::TestWithParam<std::pair<double, double>> {};

TEST_P(SunAt, IsFoundWhereItIsWithItsPowerSizeAndColour) {
  const SkyOptions sky = day(GetParam().first, GetParam().second);
  const ExtractedLights out = extract_lights(make_sky(sky));
  ASSERT_EQ(out.lights.size(), 1u);
  const DirectionalLight& sun = out.lights[0];
  EXPECT_LT(angle(sun.direction, sun_direction(daylight(sky))), 0.1 * degree);
  const Rgb truth = sun_irradiance(daylight(sky));
  EXPECT_NEAR(sun.illuminance / luminance(truth), 1, 0.01);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sun.color[c], truth[c] / luminance(truth), 0.01) << "channel " << c;
  // A disc known by the texels (0.35 degrees) that it touches.
  EXPECT_NEAR(sun.angular_radius / degree, 0.5 * sun_diameter_degrees, 0.04);
}

INSTANTIATE_TEST_SUITE_P(Heights, SunAt,
                         testing::Values(std::pair{8.0, 30.0}, std::pair{20.0, 179.95},
                                         std::pair{45.0, 200.0}, std::pair{70.0, -75.3},
                                         std::pair{89.9, 10.0}),
                         [](const auto& at) {
                           return "Elevation" + std::to_string(static_cast<int>(at.param.first));
                         });

TEST(Lights, ResidualAndLightsGiveTheIrradianceOfTheMap) {
  const Image map = make_sky(day(35));
  const ExtractedLights out = extract_lights(map);
  ASSERT_EQ(out.lights.size(), 1u);
  const std::vector<Vec3> normals = normals_for(out.lights[0]);
  const std::vector<double> truth = irradiance(map, normals), rest = irradiance(out.residual, normals);
  const double largest = *std::max_element(truth.begin(), truth.end());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto as_direction = directional_irradiance(out.lights[0], normals[i]);
    const auto as_disc = disc_irradiance(out.lights[0], normals[i]);
    // At the kink a disc of radius a gives 2 a / (3 pi) of its irradiance, a direction none: 1e-3 for 0.27 degrees. In
    // the map the sun is as wide as the texels that it touches, which the disc is not.
    EXPECT_NEAR(rest[i] + luminance_of(as_direction.data()), truth[i], 1.1e-3 * largest);
    EXPECT_NEAR(rest[i] + luminance_of(as_disc.data()), truth[i], 5e-4 * largest);
  }
}

TEST(Lights, ResidualIsTheSkyWithoutTheSun) {
  SkyOptions options = day(35);
  const ExtractedLights out = extract_lights(make_sky(options));
  options.sun = false;
  const Image truth = make_sky(options);
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    ASSERT_NEAR(out.residual.pixels[i], truth.pixels[i], 0.03f * truth.pixels[i] + 1e-3f) << i;
}

TEST(Lights, ResidualIsNowhereAboveTheMap) {
  Image map = noise_map(256, 128, 3);
  for (float& v : map.pixels) v = std::pow(v, 8.0f);  // specks
  const ExtractedLights out =
      extract_lights(map, {.max_lights = 20, .max_angular_radius = 15, .min_share = 0});
  ASSERT_FALSE(out.lights.empty());
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    ASSERT_LE(out.residual.pixels[i], map.pixels[i]);
    ASSERT_GE(out.residual.pixels[i], 0);
  }
}

TEST(Lights, NineCoefficientsAndTheSunHoldTheIrradiance) {
  for (double elevation : {20.0, 40.0, 65.0}) {
    const Image map = make_sky(day(elevation, 30, 256));
    const ExtractedLights out = extract_lights(map);
    ASSERT_EQ(out.lights.size(), 1u);
    const std::vector<Vec3> normals = normals_for(out.lights[0]);
    const std::vector<double> truth = irradiance(map, normals);
    const double largest = *std::max_element(truth.begin(), truth.end());
    const auto plain = convolve(project_equirect(map, 2), cosine_lobe(2));
    const auto rest = convolve(project_equirect(out.residual, 2), cosine_lobe(2));
    double plain_error = 0, error = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      std::array<double, 3> p{}, r{};
      evaluate(plain, normals[i], p);
      evaluate(rest, normals[i], r);
      const auto sun = directional_irradiance(out.lights[0], normals[i]);
      plain_error = std::max(plain_error, std::abs(luminance_of(p.data()) - truth[i]));
      error = std::max(error, std::abs(luminance_of(r.data()) + luminance_of(sun.data()) - truth[i]));
    }
    EXPECT_GT(plain_error, 0.05 * largest) << elevation;
    EXPECT_LT(error, 0.005 * largest) << elevation;
  }
}

TEST(Lights, WithoutAStrongCompactSourceThereAreNone) {
  SkyOptions overcast;
  overcast.kind = SkyKind::overcast;
  overcast.width = 256, overcast.height = 128;
  for (const Image& map : {make_sky(overcast), constant_map(64, 32, 3), Image(16, 8)}) {
    const ExtractedLights out = extract_lights(map);
    EXPECT_TRUE(out.lights.empty());
    EXPECT_EQ(out.residual.pixels, map.pixels);
  }
}

// A disc of radiance on a dim background.
Image lamps(int height, const std::vector<std::pair<Vec3, double>>& discs) {
  Image map = constant_map(2 * height, height, 0.01f);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec3 d = equirect_direction({(x + 0.5) / map.width, (y + 0.5) / map.height});
      for (const auto& [centre, radius] : discs)
        if (angle(d, normalized(centre)) < radius * degree)
          for (int c = 0; c < 3; ++c) map.at(x, y)[c] = 100 - 20 * static_cast<float>(c);
    }
  return map;
}

TEST(Lights, SeveralLampsAreSeparateLightsStrongestFirst) {
  const Image map = lamps(512, {{{0, 1, 0.2}, 4}, {{-1, 0, 0.01}, 6}, {{0.5, -0.7, -0.5}, 2}});
  const ExtractedLights out = extract_lights(map, {.max_lights = 8, .max_angular_radius = 10});
  ASSERT_EQ(out.lights.size(), 3u);
  const double radii[3] = {6, 4, 2};
  const Vec3 centres[3] = {{-1, 0, 0.01}, {0, 1, 0.2}, {0.5, -0.7, -0.5}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(angle(out.lights[i].direction, normalized(centres[i])), 0.1 * degree) << i;
    EXPECT_NEAR(out.lights[i].angular_radius / degree, radii[i], 0.02 * radii[i]) << i;
    const double disc = std::numbers::pi * std::pow(std::sin(radii[i] * degree), 2);
    EXPECT_NEAR(out.lights[i].irradiance[0], 100 * disc, 0.03 * 100 * disc) << i;  // 0.35 degree texels
    EXPECT_NEAR(out.lights[i].irradiance[2] / out.lights[i].irradiance[0], 0.6, 1e-3) << i;
  }
  EXPECT_LE(*std::max_element(out.residual.pixels.begin(), out.residual.pixels.end()), 0.0101f);
}

TEST(Lights, OnlyAsManyAsAskedForAndNoneThatAreTooLarge) {
  const Image map = lamps(256, {{{0, 1, 0.2}, 4}, {{-1, 0, 0.01}, 6}, {{0.5, -0.7, -0.5}, 2}});
  EXPECT_EQ(extract_lights(map, {.max_lights = 2, .max_angular_radius = 10}).lights.size(), 2u);
  const auto small = extract_lights(map, {.max_lights = 8, .max_angular_radius = 5}).lights;
  ASSERT_EQ(small.size(), 2u);
  EXPECT_NEAR(small[0].angular_radius / degree, 4, 0.1);
}

TEST(Lights, PanesOfAWindowAreOneLight) {
  const Image map =
      lamps(512, {{{1, 0.1, 0.1}, 2}, {{1, 0.1, -0.1}, 2}, {{1, -0.1, 0.1}, 2}, {{1, -0.1, -0.1}, 2}});
  const auto wide = extract_lights(map, {.max_lights = 8, .max_angular_radius = 15}).lights;
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_LT(angle(wide[0].direction, {1, 0, 0}), 0.1 * degree);
  EXPECT_EQ(extract_lights(map, {.max_lights = 8, .max_angular_radius = 3}).lights.size(), 4u);
}

TEST(Lights, WhatIsLeftOverIsSearchedAgain) {
  // A small bright disc in a wide dimmer one: the sun and its glow.
  Image map = lamps(256, {{{1, 0.3, 0}, 1}});
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec3 d = equirect_direction({(x + 0.5) / map.width, (y + 0.5) / map.height});
      if (map.at(x, y)[0] < 1 && angle(d, normalized(Vec3{1, 0.3, 0})) < 8 * degree)
        for (int c = 0; c < 3; ++c) map.at(x, y)[c] = 0.05f;
    }
  const auto lights =
      extract_lights(map, {.max_lights = 2, .max_angular_radius = 10, .min_share = 0.001}).lights;
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_NEAR(lights[0].angular_radius / degree, 1, 0.2);  // texels of 0.7 degrees
  EXPECT_NEAR(lights[1].angular_radius / degree, 8, 0.2);
}

TEST(Lights, DiscIrradianceIsTheIntegralOverTheDisc) {
  for (double radius : {0.3, 5.0, 40.0}) {
    const double a = radius * degree;
    DirectionalLight light;
    light.direction = {0, 1, 0};
    light.angular_radius = a;
    light.irradiance = {std::numbers::pi * std::sin(a) * std::sin(a), 0, 0};  // radiance 1
    for (double tilt : {0.0, 0.5, 1.0, 1.4, 1.5, std::numbers::pi / 2, 1.6, 1.8, 2.5, std::numbers::pi}) {
      const Vec3 n{std::sin(tilt), std::cos(tilt), 0};
      double sum = 0;
      constexpr int rings = 400, parts = 800;
      for (int i = 0; i < rings; ++i)
        for (int j = 0; j < parts; ++j) {
          const double c = 1 - (1 - std::cos(a)) * (i + 0.5) / rings, s = std::sqrt(1 - c * c);
          const double p = 2 * std::numbers::pi * (j + 0.5) / parts;
          sum += std::max(0.0, dot(n, Vec3{s * std::cos(p), c, s * std::sin(p)}));
        }
      sum *= 2 * std::numbers::pi * (1 - std::cos(a)) / (rings * parts);
      EXPECT_NEAR(disc_irradiance(light, n)[0], sum, 1e-4 * light.irradiance[0]) << radius << " " << tilt;
    }
  }
}

TEST(Lights, ADiscWithoutExtentIsADirection) {
  DirectionalLight light;
  light.direction = {0, 0, 1};
  light.irradiance = {1, 2, 3};
  for (Vec3 n : sphere_points(50)) EXPECT_EQ(disc_irradiance(light, n), directional_irradiance(light, n));
}

TEST(Lights, OptionsOutOfRangeAreErrors) {
  const Image map = constant_map(8, 4, 1);
  EXPECT_THROW(extract_lights(map, {.max_lights = 0}), Error);
  EXPECT_THROW(extract_lights(map, {.max_angular_radius = 0}), Error);
  EXPECT_THROW(extract_lights(map, {.max_angular_radius = std::nan("")}), Error);
  EXPECT_THROW(extract_lights(map, {.min_share = 2}), Error);
}

}  // namespace
}  // namespace welkin
