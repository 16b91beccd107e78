#include <welkin/envmap/sky/sky.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include <welkin/envmap/sky/daylight.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// Irradiance of a surface that faces up, texel by texel with the exact integral of the cosine,
// 2 pi / W * (cos^2 t0 - cos^2 t1) / 2.
Rgb irradiance_from_above(const Image& map) {
  Rgb sum{};
  for (int j = 0; j < map.height / 2; ++j) {
    const double top = std::cos(pi * j / map.height), bottom = std::cos(pi * (j + 1) / map.height);
    const double weight = pi / map.width * (top * top - bottom * bottom);
    for (int i = 0; i < map.width; ++i)
      for (int c = 0; c < 3; ++c) sum[c] += weight * static_cast<double>(map.at(i, j)[c]);
  }
  return sum;
}

std::string message_of(const std::string& spec) {
  try {
    make_sky(parse_sky(spec));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

// The sky comes from the map; the sun, which stands anywhere within its texel, from its own irradiance and sine.
TEST(DaySky, GroundReflectsWhatFallsOnIt) {
  const Image map = make_sky(parse_sky("sky:day,size=256x128,albedo=0.3,elevation=35,sun=0"));
  const Rgb irradiance = irradiance_from_above(map) + std::sin(35 * pi / 180) * sun_irradiance({35, 30, 3});
  for (int c = 0; c < 3; ++c) {
    const double expected = 0.3 * irradiance[c] / pi;
    // A texel's mean radiance times its mean cosine is not the mean of the product: 1e-4 for texels of 1.4 degrees.
    EXPECT_NEAR(static_cast<double>(map.at(7, 100)[c]), expected, 2e-4 * expected);
  }
}

// The map with the sun minus the map without it is the disc: radiance times solid angle, at any size.
TEST(DaySky, SunHasItsEnergyAtAnySize) {
  for (const char* size : {"2x1", "64x32", "1024x512", "501x250"}) {
    SkyOptions options = parse_sky(std::string("sky:day,elevation=50,size=") + size);
    const Image with = make_sky(options);
    options.sun = false;
    const Image without = make_sky(options);
    double energy = 0;
    for (int j = 0; j < with.height; ++j)
      for (int i = 0; i < with.width; ++i)
        energy += equirect_texel_solid_angle(with.width, with.height, j) *
                  (static_cast<double>(with.at(i, j)[1]) - static_cast<double>(without.at(i, j)[1]));
    const double expected = sun_irradiance({50, 30, 3})[1];
    EXPECT_NEAR(energy, expected, 1e-5 * expected) << size;  // floats
  }
}

TEST(DaySky, SunStandsWhereItIsAskedFor) {
  const Image map = make_sky(parse_sky("sky:day,elevation=30,azimuth=90,size=64x32"));
  int best_x = 0, best_y = 0;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 64; ++i)
      if (map.at(i, j)[0] > map.at(best_x, best_y)[0]) best_x = i, best_y = j;
  const Vec3 d = equirect_direction({(best_x + 0.5) / 64, (best_y + 0.5) / 32});
  EXPECT_GT(d.z, 0.8);  // azimuth 90 is +Z
  EXPECT_NEAR(d.y, 0.5, 0.06);
}

// CIE overcast: horizon a third of the zenith, E = 7 pi / 9 of the zenith's radiance (Moon & Spencer 1942), the ground
// albedo E / pi; 300 + 21000 sin 35 degrees lx in all.
TEST(OvercastSky, FollowsTheStandard) {
  const Image map = make_sky(parse_sky("sky:overcast,size=512x256,albedo=0.25,elevation=35"));
  const double zenith = static_cast<double>(map.at(0, 0)[0]);
  EXPECT_NEAR(static_cast<double>(map.at(0, 127)[1]) / zenith, 1.0 / 3,
              0.01);  // half a texel above the horizon
  const double irradiance = irradiance_from_above(map)[2];
  EXPECT_NEAR(irradiance, 7 * pi / 9 * zenith, 2e-4 * irradiance);  // the zenith texel is half a degree wide
  EXPECT_NEAR(static_cast<double>(map.at(5, 200)[0]), 0.25 * irradiance / pi, 1e-4 * irradiance);
  EXPECT_NEAR(irradiance * luminous_efficacy, 300 + 21000 * std::sin(35 * pi / 180), 2);
}

TEST(AnalyticSky, ConstantTexelAndRampAreExact) {
  const Image constant = make_sky(parse_sky("sky:constant,value=1:2:0.5,size=8x4,scale=2"));
  for (int i = 0; i < 32; ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_FLOAT_EQ(constant.pixels[3 * i + c], (c == 0 ? 2.0f : c == 1 ? 4.0f : 1.0f));
  const Image texel = make_sky(parse_sky("sky:texel,value=3,x=5,y=1,size=8x4"));
  for (int i = 0; i < 32; ++i) ASSERT_EQ(texel.pixels[3 * i], i == 13 ? 3.0f : 0.0f);
  // The mean of y over a texel is the mean of its edges' cosines.
  const Image ramp = make_sky(parse_sky("sky:ramp,offset=2,slope=0.5,size=8x5"));
  for (int j = 0; j < 5; ++j) {
    const double mean = (std::cos(pi * j / 5) + std::cos(pi * (j + 1) / 5)) / 2;
    ASSERT_NEAR(static_cast<double>(ramp.at(3, j)[2]), 2 + 0.5 * mean, 1e-6);
  }
}

// Y_1-1 = 0.488603 y is a ramp; the mean of any Y_lm over the sphere is 0; a large map has the function's own values.
TEST(AnalyticSky, SphericalHarmonicsAreTheBasis) {
  const Image y = make_sky(parse_sky("sky:sh,degree=1,order=-1,offset=0,size=16x8"));
  const Image ramp = make_sky(parse_sky("sky:ramp,offset=0,slope=0.48860251190292,size=16x8"));
  for (std::size_t i = 0; i < y.pixels.size(); ++i) ASSERT_NEAR(y.pixels[i], ramp.pixels[i], 1e-6f);
  const Image map = make_sky(parse_sky("sky:sh,degree=6,order=3,offset=2,size=64x32"));
  double sum = 0;
  for (int j = 0; j < 32; ++j)
    for (int i = 0; i < 64; ++i)
      sum += equirect_texel_solid_angle(64, 32, j) * static_cast<double>(map.at(i, j)[0]);
  EXPECT_NEAR(sum, 4 * pi * 2, 1e-5);
}

TEST(Studio, IsLitAndFinite) {
  const Image map = make_sky(parse_sky("sky:studio,size=128x64"));
  float brightest = 0, darkest = 1e9f;
  for (float p : map.pixels) {
    ASSERT_TRUE(std::isfinite(p));
    brightest = std::max(brightest, p);
    darkest = std::min(darkest, p);
  }
  EXPECT_GT(brightest, 20);
  EXPECT_GT(darkest, 0.01f);
  EXPECT_LT(darkest, 0.1f);
}

TEST(Sky, IsTheSameOnAnyNumberOfThreads) {
  set_thread_count(1);
  const Image one = make_sky(parse_sky("size=64x32"));
  set_thread_count(8);
  EXPECT_EQ(make_sky(parse_sky("size=64x32")).pixels, one.pixels);
  set_thread_count(0);
}

TEST(SkySpec, ReadsKindAndKeys) {
  const SkyOptions options =
      parse_sky("sky:overcast,elevation=-3.5,size=64x32,sun=0,value=1:0.5:0.25,degree=3");
  EXPECT_EQ(options.kind, SkyKind::overcast);
  EXPECT_EQ(options.elevation, -3.5);
  EXPECT_EQ(options.width, 64);
  EXPECT_EQ(options.height, 32);
  EXPECT_FALSE(options.sun);
  EXPECT_EQ(options.value, (Rgb{1, 0.5, 0.25}));
  EXPECT_EQ(options.degree, 3);
  EXPECT_EQ(parse_sky("sky:").kind, SkyKind::day);
  EXPECT_EQ(parse_sky("sky:turbidity=4").turbidity, 4);
  EXPECT_TRUE(is_sky_spec("sky:") && !is_sky_spec("sky.hdr"));
}

TEST(SkySpec, NamesWhatIsWrongAndWhatIsValid) {
  EXPECT_NE(message_of("sky:dawn").find("unknown kind 'dawn'; valid are day, studio, overcast"),
            std::string::npos);
  EXPECT_NE(message_of("sky:day,haze=3").find("unknown key 'haze'; valid are size, elevation"),
            std::string::npos);
  EXPECT_NE(message_of("sky:day,elevation=high").find("elevation=high is not a number"), std::string::npos);
  EXPECT_NE(message_of("sky:day,turbidity=1").find("turbidity must be 1.7 to 10"), std::string::npos);
  EXPECT_NE(message_of("sky:day,turbidity=nan").find("turbidity must be"), std::string::npos);
  EXPECT_NE(message_of("sky:size=512").find("size=512 is not of the form"), std::string::npos);
  EXPECT_NE(message_of("sky:size=0x1").find("size must be"), std::string::npos);
  EXPECT_NE(message_of("sky:size=65536x65536").find("2^30 texels"), std::string::npos);
  EXPECT_NE(message_of("sky:sh,degree=1,order=2").find("order must be"), std::string::npos);
  EXPECT_NE(message_of("sky:day,studio").find("not of the form key=value"), std::string::npos);
}

// Mean radiance over the sphere, one channel.
double mean_green(const Image& map) {
  double sum = 0;
  for (int j = 0; j < map.height; ++j)
    for (int i = 0; i < map.width; ++i)
      sum += equirect_texel_solid_angle(map.width, map.height, j) * static_cast<double>(map.at(i, j)[1]);
  return sum / (4 * pi);
}

// Texels are means: the mean of all of them is that of the sphere, however wide or narrow they are.
TEST(AllSkies, TheMeanDoesNotDependOnTheProportion) {
  for (const std::string kind : {"day,sun=0", "studio"}) {
    const double wide = mean_green(make_sky(parse_sky("sky:" + kind + ",size=2048x1024")));
    for (const char* size : {"1x1024", "2x512", "2048x64"}) {
      const double mean = mean_green(make_sky(parse_sky("sky:" + kind + ",size=" + size)));
      // The studio's soft boxes have edges that the nodes resolve to about a tenth of a per cent.
      EXPECT_NEAR(mean, wide, 1e-3 * wide) << kind << " " << size;
    }
  }
}

// Beyond 1e30 what is made of a map, its irradiance at last, leaves float.
TEST(AllSkies, NumbersBeyond1e30AreRefusedByName) {
  EXPECT_NE(message_of("sky:constant,value=1e300,size=4x2").find("value must be"), std::string::npos);
  EXPECT_NE(message_of("sky:constant,value=3e38,size=4x2").find("value must be"), std::string::npos);
  EXPECT_NE(message_of("sky:ramp,value=1:-2e30:1,size=4x2").find("value must be"), std::string::npos);
  EXPECT_NE(message_of("sky:studio,scale=1e31,size=4x2").find("scale must be"), std::string::npos);
  EXPECT_NE(message_of("sky:ramp,offset=1e31,size=4x2").find("offset and slope must be"), std::string::npos);
  EXPECT_NE(message_of("sky:constant,value=1e20,scale=1e20,size=4x2").find("value times scale"),
            std::string::npos);
  EXPECT_EQ(message_of("sky:constant,value=1e30,size=4x2"), "");
}

}  // namespace
}  // namespace welkin
