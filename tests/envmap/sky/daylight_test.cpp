#include <welkin/envmap/sky/daylight.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/envmap/sky/disc_coverage.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

double lux(Rgb irradiance) { return luminous_efficacy * luminance(irradiance); }

// Clear days: direct normal illuminance is 80 to 105 klx with the sun above 40 degrees (127.5 klx outside the
// atmosphere, IES Handbook; clear-day records end near 110), and the light of the sun on the ground is 3 to 8 times the
// sky's (diffuse fraction 0.11 to 0.25 of clear skies: Duffie & Beckman).
TEST(Daylight, SunAndSkyAreInTheMeasuredRange) {
  for (double turbidity : {2.0, 2.5, 3.0})
    for (double elevation : {45.0, 60.0, 90.0}) {
      const DaylightOptions options{elevation, 0, turbidity};
      const double direct = lux(sun_irradiance(options));
      EXPECT_GT(direct, 75'000) << turbidity << " " << elevation;
      EXPECT_LT(direct, 105'000) << turbidity << " " << elevation;
      const double sky = lux(PreethamSky(options).horizontal_irradiance());
      const double ratio = direct * std::sin(elevation * pi / 180) / sky;
      EXPECT_GT(ratio, 2.5) << turbidity << " " << elevation;
      EXPECT_LT(ratio, 9) << turbidity << " " << elevation;
    }
}

// At sunset a clear sky gives 200 to 800 lx; at -6 degrees 3.4 lx (Seidelmann 1992), whatever the haze.
TEST(Daylight, SunsetAndTwilightAreInTheMeasuredRange) {
  const double sunset = lux(PreethamSky({0, 0, 2.5}).horizontal_irradiance());
  EXPECT_GT(sunset, 150);
  EXPECT_LT(sunset, 800);
  const double dusk = lux(PreethamSky({-6, 0, 2.5}).horizontal_irradiance());
  EXPECT_NEAR(dusk / sunset, 3.4 / 400, 0.01 * 3.4 / 400);  // log10 rounded to three digits
  EXPECT_GT(lux(PreethamSky({-90, 0, 2.5}).horizontal_irradiance()), 0);
}

// A low sun is red and a high one nearly white; the zenith of a clear sky is blue, correlated colour temperature above
// 9000 K, so x and y below D65's (0.313, 0.329).
TEST(Daylight, ColoursAreRight) {
  const Rgb low = sun_irradiance({5, 0, 2.5}), high = sun_irradiance({60, 0, 2.5});
  EXPECT_GT(low[0], 3 * low[2]);
  EXPECT_LT(high[0], 1.6 * high[2]);
  EXPECT_GT(high[0], high[2]);
  const Rgb zenith = PreethamSky({40, 0, 2.5}).radiance({0, 1, 0});
  EXPECT_GT(zenith[2], 1.5 * zenith[0]);
  EXPECT_GT(zenith[1], zenith[0]);
}

// The published zenith luminance at T = 3 and 50 degrees of zenith angle, worked out by hand from Preetham et al. 1999,
// A.2: chi = (4/9 - 3/120) (pi - 2 * 0.872665) = 0.585656, Y = 7.1649 tan(chi) + 1.7727 = 6.5230 kcd/m^2.
TEST(Daylight, PublishedZenithIsKept) {
  DaylightOptions options{40, 0, 3};
  options.published_zenith = true;
  EXPECT_NEAR(luminous_efficacy * luminance(PreethamSky(options).radiance({0, 1, 0})), 6523,
              12);  // Rec.709 rounding
}

// Perez's distribution of luminance at T = 3, the sun at 50 degrees from the zenith, by hand from the same appendix:
// A = -0.9269, B = -0.6387, C = 5.2570, D = -2.2153, E = 0.1693. On the horizon, 90 degrees from the sun,
// F = 1 + C e^(D pi / 2) = 1.1620; at the zenith F = (1 + A e^B) (1 + C e^(0.872665 D) + E cos^2 50) = 0.51062 * 1.8305.
TEST(Daylight, HorizonOverZenithIsPreethams) {
  const PreethamSky sky({40, 0, 3});
  const double ratio = luminance(sky.radiance({0, 0, 1})) / luminance(sky.radiance({0, 1, 0}));
  EXPECT_NEAR(ratio, 1.1620 / (0.51062 * 1.8305), 3e-3);  // Rec.709 rounds luminance by colour
}

// Zenith chromaticity for the same sky, from the polynomials of the appendix: (0.2444, 0.2505). The matrix back from Rec.709
// to XYZ is the published inverse (four digits).
TEST(Daylight, ZenithChromaticityIsPreethams) {
  const Rgb c = PreethamSky({40, 0, 3}).radiance({0, 1, 0});
  const double x = 0.4124 * c[0] + 0.3576 * c[1] + 0.1805 * c[2];
  const double y = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  const double z = 0.0193 * c[0] + 0.1192 * c[1] + 0.9505 * c[2];
  EXPECT_NEAR(x / (x + y + z), 0.2444, 2e-4);
  EXPECT_NEAR(y / (x + y + z), 0.2505, 2e-4);
}

TEST(Daylight, SkyIsSymmetricAboutTheSunsMeridian) {
  const PreethamSky sky({30, 40, 3});
  for (double away : {0.3, 1.0, 2.5}) {
    const auto at = [&](double phi) { return sky.radiance({0.8 * std::cos(phi), 0.6, 0.8 * std::sin(phi)}); };
    const double sun = 40 * pi / 180;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(sun + away)[c], at(sun - away)[c], 1e-12 * at(sun)[c]);
  }
}

TEST(Daylight, IsFiniteAndPositiveForEverySunAndHaze) {
  for (double turbidity = 1.7; turbidity < 10.1; turbidity += 1.66)
    for (double elevation = -90; elevation <= 90; elevation += 7.5) {
      const DaylightOptions options{elevation, 10, std::min(turbidity, 10.0)};
      const PreethamSky sky(options);
      for (Vec3 d : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, normalized(Vec3{1, 0.01, 1}),
                     sun_direction(options)})
        for (double v : sky.radiance(d)) {
          EXPECT_TRUE(std::isfinite(v)) << turbidity << " " << elevation;
          EXPECT_GE(v, 0);
          EXPECT_LT(v, 5000);  // not the explosion of the fit below T = 2
        }
      EXPECT_GT(luminance(sky.radiance({0, 1, 0})), 0) << turbidity << " " << elevation;
      for (double v : sun_irradiance(options)) EXPECT_TRUE(std::isfinite(v) && v >= 0);
    }
}

double covered(int width, int height, Vec3 centre, double radius) {
  double sum = 0;
  for (const Coverage& texel : disc_coverage(width, height, centre, radius)) {
    EXPECT_LE(texel.fraction, 1);
    sum += texel.fraction * equirect_texel_solid_angle(width, height, texel.y);
  }
  return sum;
}

// The fractions add up to the disc, 2 pi (1 - cos r), in maps from one texel to many times finer than the disc, at the
// pole, across the map's left and right edges, and near the horizon.
TEST(DiscCoverage, AddsUpToTheDisc) {
  for (double radius : {0.004625, 0.2})
    for (Vec3 centre :
         {Vec3{0, 1, 0}, Vec3{1e-3, 1, 0}, Vec3{-1, 0.5, 1e-4}, Vec3{0.3, 0.7, -0.2}, Vec3{1, 0.21, 0}})
      for (auto [width, height] : {std::pair{1, 1}, {2, 1}, {16, 8}, {1024, 512}, {333, 777}}) {
        const double disc = 4 * pi * std::pow(std::sin(radius / 2), 2);
        EXPECT_NEAR(covered(width, height, normalized(centre), radius) / disc, 1, 1e-8)
            << width << " " << radius;
      }
}

// Half of the disc is above the horizon when its centre lies on it; none when it is below by more than the radius.
TEST(DiscCoverage, IsCutAtTheHorizon) {
  EXPECT_NEAR(covered(1024, 512, {1, 0, 0}, 0.004625), 2 * pi * std::pow(std::sin(0.004625 / 2), 2), 1e-12);
  EXPECT_EQ(covered(1024, 512, normalized({1, -0.0047, 0}), 0.004625), 0);
}

// Texels wholly inside have fraction 1, texels on the rim the share that a fine grid of points finds.
TEST(DiscCoverage, EachTexelMatchesAPointCount) {
  const Vec3 centre = normalized({1, 0.5, 0.4});
  const double radius = 0.12;
  constexpr int n = 200;
  int whole = 0;
  for (const Coverage& texel : disc_coverage(128, 64, centre, radius)) {
    double inside = 0, all = 0;
    for (int i = 0; i < n * n; ++i) {
      const double v = (texel.y + (i / n + 0.5) / n) / 64;
      const bool in =
          dot(equirect_direction({(texel.x + (i % n + 0.5) / n) / 128, v}), centre) > std::cos(radius);
      inside += in ? std::sin(pi * v) : 0;
      all += std::sin(pi * v);
    }
    // n^-3/2 of the count, and the kinks at the columns' edges in 48 nodes a row.
    EXPECT_NEAR(texel.fraction, inside / all, 2e-3) << texel.x << " " << texel.y;
    whole += texel.fraction > 1 - 1e-9;
  }
  EXPECT_GT(whole, 8);
}

}  // namespace
}  // namespace welkin
