#include <algorithm>
#include <cmath>
#include <numbers>

#include "command_test.h"
#include "ibl_set.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/lights.h>
#include <welkin/envmap/sky/daylight.h>
#include <welkin/image/load.h>
#include <welkin/sphere/cube.h>

// --extract-sun and --extract-lights: what leaves the set is in the manifest, and both together are the environment.

namespace welkin {
namespace {

using LightsCommandTest = CommandTest;
using Arguments = std::vector<std::string>;

const Arguments small{"--size", "32", "--irradiance-size", "16", "--dfg-size", "8", "--format", "rgba32f"};

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double luminance_of(const float* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

TEST_F(LightsCommandTest, TheSetAndTheSunAreTheEnvironment) {
  run_well(Arguments{"ibl", "sky:day,elevation=30", "-o", "whole"} + small);
  const std::string out =
      run_well(Arguments{"ibl", "sky:day,elevation=30", "-o", "parts", "--extract-sun"} + small);
  EXPECT_NE(out.find("illuminance"), std::string::npos);
  const LoadedSet whole = load_set(at("whole")), parts = load_set(at("parts"));
  EXPECT_FALSE(whole.manifest.contains("lights"));
  expect_complete(at("parts"));
  ASSERT_EQ(parts.manifest["lights"].size(), 1u);
  const auto& sun = parts.manifest["lights"][0];
  const DaylightOptions daylight{30, 30, 3, false};
  const Vec3 truth = sun_direction(daylight);
  const Vec3 d{sun["direction"][0], sun["direction"][1], sun["direction"][2]};
  EXPECT_LT(length(d - truth), 0.1 * std::numbers::pi / 180);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(sun["irradiance"][c].get<double>(), sun_irradiance(daylight)[c],
                0.01 * sun_irradiance(daylight)[c]);
  const Cube &a = whole.irradiance.levels[0], &b = parts.irradiance.levels[0];
  double largest = 0;
  for (std::size_t i = 0; i < a.texels.size(); i += 3)
    largest = std::max(largest, luminance_of(&a.texels[i]));
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < a.size; ++y)
      for (int x = 0; x < a.size; ++x) {
        const Vec3 n = cube_texel_direction(a.size, face, x, y);
        const double light = sun["illuminance"].get<double>() * std::max(0.0, dot(n, d));
        // The kink of a sun of 0.27 degrees, and a smaller step for the filter's own error.
        ASSERT_NEAR(luminance_of(b.at(face, x, y)) + light, luminance_of(a.at(face, x, y)), 1.3e-3 * largest);
      }
  EXPECT_LT(parts.manifest["lights_error"]["as_directions"]["max"].get<double>(), 1.3e-3);
  EXPECT_LT(parts.manifest["lights_error"]["as_discs"]["max"].get<double>(), 5e-4);
  const std::string page = read_text(at("parts/index.html"));
  EXPECT_NE(page.find("Angular radius"), std::string::npos);
}

TEST_F(LightsCommandTest, TheResidualIsWrittenWithTheSet) {
  run_well(Arguments{"ibl", "sky:day,size=128x64", "-o", "set", "--extract-sun", "--residual", "rest.exr"} +
           small);
  const Image written = load_image(at("rest.exr")).flat;
  const Image rest = extract_lights(load_environment("sky:day,size=128x64").radiance).residual;
  ASSERT_EQ(written.pixels.size(), rest.pixels.size());
  for (std::size_t i = 0; i < rest.pixels.size(); ++i)
    ASSERT_NEAR(written.pixels[i], rest.pixels[i], 5e-4f * rest.pixels[i] + 1e-6f);  // half floats: 2^-11
}

TEST_F(LightsCommandTest, AMapWithoutASunSaysSo) {
  const std::string out =
      run_well(Arguments{"ibl", "sky:overcast,size=128x64", "-o", "set", "--extract-sun"} + small);
  EXPECT_NE(out.find("no light"), std::string::npos);
  EXPECT_EQ(json("set/manifest.json")["lights"].size(), 0u);
}

TEST_F(LightsCommandTest, AMapThatIsNothingButALightIsAnError) {
  const RunResult result =
      run(Arguments{"ibl", "sky:texel,size=256x128", "-o", "set", "--extract-sun"} + small);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("nothing but its lights"), std::string::npos) << result.err;
  EXPECT_EQ(line_count(result.err), 1u);
  EXPECT_FALSE(std::filesystem::exists(at("set")));
}

TEST_F(LightsCommandTest, MisuseIsAUsageError) {
  const std::vector<Arguments> wrong{{"--light-radius", "5"},
                                     {"--residual", "a.exr"},
                                     {"--extract-sun", "--extract-lights", "2"},
                                     {"--extract-lights", "0"},
                                     {"--extract-sun", "--light-radius", "nan"},
                                     {"--extract-sun", "--light-radius", "90"}};
  for (const Arguments& options : wrong) {
    const RunResult result = run(Arguments{"ibl", "sky:day,size=64x32", "-o", "set"} + small + options);
    EXPECT_EQ(result.exit_code, 2) << options[0];
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
    EXPECT_FALSE(std::filesystem::exists(at("set")));
  }
  const RunResult result = run(
      Arguments{"ibl", "sky:day,size=64x32", "-o", "set", "--extract-sun", "--residual", "a.ktx2"} + small);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("a.ktx2"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at("set")));
}

}  // namespace
}  // namespace welkin
