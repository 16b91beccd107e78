#include <cmath>
#include <sstream>

#include "command_test.h"
#include "ibl_set.h"

#include <welkin/envmap/ibl.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>

// What the command does with the split sum, stretched taps and Fresnel's blend.

namespace welkin {
namespace {

using SplitSumCommandTest = CommandTest;

TEST_F(SplitSumCommandTest, TheTableOfTapsIsThatOfTheLibrary) {
  run_well({"ibl", "sky:day,size=64x32", "-o", "out", "--size", "32", "--irradiance-size", "8", "--dfg-size",
            "8", "--stretched-taps"});
  expect_complete(at("out"));
  const StretchedTapsTable table = make_stretched_taps_table({32, default_levels(32), LevelLaw::linear});
  const Image expected = stretched_taps_image(table);
  const LoadedImage stored =
      decode_ktx2(read_file(at("out/stretched_taps.ktx2").string()), "stretched_taps.ktx2");
  ASSERT_EQ(stored.flat.width, expected.width);
  ASSERT_EQ(stored.flat.height, expected.height);
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    const float value = expected.pixels[i];
    ASSERT_NEAR(stored.flat.pixels[i / 2 * 3 + i % 2], value, std::abs(value) * std::exp2(-11) + 6e-8);
  }
  EXPECT_EQ(json("out/manifest.json")["stretched_taps"]["taps"], 3);
  EXPECT_EQ(read_text(at("out/stretched_taps.glsl")), stretched_taps_glsl(table));
}

TEST_F(SplitSumCommandTest, TapsNeedAGgxChain) {
  const RunResult result =
      run({"ibl", "sky:day,size=64x32", "-o", "out", "--kernel", "phong", "--stretched-taps"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--stretched-taps"), std::string::npos) << result.err;
}

// The figure after the method's name and its seconds.
double mean_error(const std::string& output, const std::string& method) {
  std::istringstream line(output.substr(output.find("\n" + method) + 1));
  std::string name;
  double seconds = 0, error = 0;
  line >> name >> seconds >> error;
  return error;
}

TEST_F(SplitSumCommandTest, ReflectMeasuresAllThree) {
  const auto verified = [&](const std::string& brdf, const std::string& method) {
    const std::string out = run_well({"reflect", "sky:studio,size=64x32", "--brdf", brdf, "--method", method,
                                      "--verify", "--directions", "60"});
    const double error = mean_error(out, method);
    EXPECT_GT(error, 0) << out;
    return error;
  };
  EXPECT_LT(verified("ggx:0.36,1", "stretched"), verified("ggx:0.36,1", "split-sum") / 3);
  EXPECT_LT(verified("fresnel-blend:50,0.5:0.2:0.1,1.5", "fresnel-blend"), 0.1);  // 0.02 seen
  const RunResult result =
      run({"reflect", "sky:studio,size=64x32", "--brdf", "lambert:0.5", "--method", "stretched", "--verify"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("ggx:ALPHA"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace welkin
