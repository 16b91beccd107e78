#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <welkin/brdf/brdf_spec.h>
#include <welkin/brdf/lafortune.h>
#include <welkin/brdf/models.h>
#include <welkin/error.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

LocalVec random_direction(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const double z = uniform(random), phi = 2 * pi * uniform(random), sine = std::sqrt(1 - z * z);
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

TEST(Lafortune, WithMinusOneMinusOneOneIsPhongAboutTheMirrorDirection) {
  const IsotropicBrdf lafortune = parse_brdf("lafortune:-1:-1:1:20:0.5:0.25:1"),
                      phong = parse_brdf("phong:20,0.5:0.25:1");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.01, 1);
  for (int i = 0; i < 300; ++i) {
    const double l = uniform(random), v = uniform(random), azimuth = pi * uniform(random);
    const auto a = lafortune.value(l, v, azimuth), b = phong.value(l, v, azimuth);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 1e-10);  // rounding, times 20
  }
}

TEST(Lafortune, IsReciprocalAndAnisotropic) {
  const LafortuneBrdf brdf = parse_lafortune("-0.9:-0.5:0.8:12,0.7:0.7:0.9:5:0.3,diffuse:0.2:0.1:0");
  EXPECT_FALSE(is_isotropic(brdf));
  std::mt19937 random(2);
  double turned = 0;
  for (int i = 0; i < 300; ++i) {
    const LocalVec l = random_direction(random), v = random_direction(random);
    const auto forth = evaluate(brdf, l, v), back = evaluate(brdf, v, l);
    const auto quarter = evaluate(brdf, {-l.y, l.x, l.z}, {-v.y, v.x, v.z});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(forth[c], back[c], 1e-13 * (1 + forth[c]));
    turned = std::max(turned, std::abs(forth[0] - quarter[0]));
  }
  EXPECT_GT(turned, 0.1);  // turning the pair by 90 degrees does change it
}

TEST(Lafortune, ReflectsNoMoreThanItsScalesWhereNoCIsAboveOne) {
  // Midpoints of 200 x 400 patches: N = 12 varies over 0.3 rad, 40 patches, so well below 1e-3.
  const LafortuneBrdf brdf = parse_lafortune("-1:-0.6:0.9:12:0.6,1:1:1:3:0.25,diffuse:0.15");
  for (double cos_view : {1.0, 0.8, 0.5, 0.2, 0.05}) {
    for (double turn : {0.0, 0.7, pi / 2}) {
      const double sine = std::sqrt(1 - cos_view * cos_view);
      const LocalVec view{sine * std::cos(turn), sine * std::sin(turn), cos_view};
      double sum = 0;
      for (int i = 0; i < 200; ++i)
        for (int j = 0; j < 400; ++j) {
          const double z = std::sqrt((i + 0.5) / 200), phi = 2 * pi * (j + 0.5) / 400,
                       s = std::sqrt(1 - z * z);
          sum += evaluate(brdf, {s * std::cos(phi), s * std::sin(phi), z}, view)[1] * pi / (200 * 400);
        }
      EXPECT_LE(sum, 1 + 1e-3);
      EXPECT_GT(sum, 0.15);
    }
  }
}

TEST(Lafortune, TextsThatAreWrongAreRefused) {
  const auto refused = [](const std::string& spec, const std::string& part) {
    std::string message = "accepted";
    try {
      parse_brdf(spec);
    } catch (const Error& error) {
      message = error.what();
    }
    EXPECT_NE(message.find(part), std::string::npos) << spec << " -> " << message;
  };
  refused("lafortune:", "not a number");
  refused("lafortune:1:1:1", "at least four");
  refused("lafortune:-1:-1:1:5:1:2", "one number or three");
  refused("lafortune:diffuse:0.5", "1 to 16 lobes");
  refused("lafortune:-1:-1:3:5", "[-2, 2]");
  refused("lafortune:-1.5:-1.5:1:500", "within 1e6");
  refused("lafortune:-1:-1:1:-5", "N must lie");
  refused("lafortune:-1:-1:1:5,diffuse:2", "albedo");
  refused("lafortune:-1:-0.5:1:5", "anisotropic");
}

}  // namespace
}  // namespace welkin
