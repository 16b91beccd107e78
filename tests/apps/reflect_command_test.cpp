#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include <welkin/image/load.h>

#include "command_test.h"

// welkin reflect: pictures of spheres, and errors against brute force.

namespace welkin {
namespace {

using ReflectCommandTest = CommandTest;

Image picture(const std::filesystem::path& path) { return load_image(path.string()).flat; }

TEST_F(ReflectCommandTest, AWhiteDiffuseSphereInAWhiteRoomIsWhite) {
  run_well(
      {"reflect", "sky:constant,value=2,size=32x16", "--brdf", "lambert:0.5", "--size", "8", "-o", "s.exr"});
  const Image sphere = picture(at("s.exr"));
  ASSERT_EQ(sphere.width, 8);
  EXPECT_NEAR(sphere.at(4, 4)[0], 1, 1e-3);  // half floats
  EXPECT_NEAR(sphere.at(4, 0)[2], 1, 2e-3);  // and the horizon's texels
  EXPECT_EQ(sphere.at(0, 0)[1], 0);          // outside of the disc
}

// The sky's ramp is brightest at +Y: up in the picture.
TEST_F(ReflectCommandTest, UpIsUp) {
  run_well({"reflect", "sky:ramp,size=32x16", "--brdf", "lambert:1", "--size", "9", "-o", "s.exr"});
  const Image sphere = picture(at("s.exr"));
  EXPECT_GT(sphere.at(4, 1)[0], 1.2 * sphere.at(4, 4)[0]);
  EXPECT_LT(sphere.at(4, 7)[0], 0.8 * sphere.at(4, 4)[0]);
}

// What each method's mean error may be under a sun of about one texel, for GGX of alpha 0.5: measured and a third more for
// another compiler's rounding of fits.
double stated_mean_error(const std::string& method) {
  static const std::map<std::string, double> stated{
      {"lobes", 0.30},    // 0.23: a round lobe where the true one is long at grazing views
      {"lobes-2", 0.16},  // 0.12
      {"lobes-published",
       0.90},  // 0.67: the sun leaks in from below the horizon, which nothing holds the lobe above
      {"single-lobe", 0.32},    // 0.24
      {"shrm", 0.03},           // 0.019
      {"low-frequency", 0.16},  // 0.12: a sun has no end of degrees, and it keeps 4
      {"split-sum", 0.55},   // 0.41: the lobe of a view along the normal, its horizon nowhere, for every view
      {"stretched", 0.11}};  // 0.080
  const auto found = stated.find(method);
  return found == stated.end() ? 0 : found->second;  // 0: state a bound for a new method here
}

// Each line of the table is a method, seconds, three errors and a note.
TEST_F(ReflectCommandTest, EveryMethodIsMeasured) {
  const std::string table = run_well({"reflect", "sky:day,size=64x32", "--brdf", "ggx:0.5,0.9", "--method",
                                      "all", "--verify", "--directions", "60"});
  std::istringstream lines(table);
  std::string line, name;
  std::getline(lines, line);
  int methods = 0;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    double seconds = -1, mean = -1, rms = -1, largest = -1;
    words >> name >> seconds;
    if (!words) continue;  // a method that says why it cannot do this BRDF
    words >> mean >> rms >> largest;
    ++methods;
    EXPECT_GT(mean, 0) << line;
    EXPECT_LT(mean, stated_mean_error(name)) << line;
    EXPECT_GT(largest, rms) << line;
  }
  EXPECT_EQ(methods, 8);  // lafortune and fresnel-blend are for BRDFs of their own
}

TEST_F(ReflectCommandTest, RefusesWhatMakesNoSense) {
  const auto fails = [&](const Arguments& arguments, int code, const char* what) {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
  };
  const std::string sky = "sky:constant,size=8x4";
  fails({"reflect", sky, "--brdf", "ggx:0.5"}, 2, "nothing to do");
  fails({"reflect", sky, "--brdf", "ggx:0.5", "--method", "all", "-o", "s.exr"}, 2, "--method all");
  fails({"reflect", sky, "--brdf", "ggx:0.5", "--verify"}, 2, "compares with brute");
  fails({"reflect", sky, "--brdf", "ggx:0.5", "--method", "magic", "--verify"}, 1, "choose one of brute");
  fails({"reflect", sky, "--brdf", "velvet", "-o", "s.exr"}, 1, "valid are lambert");
  fails({"reflect", sky, "--brdf", "merl:none.binary", "-o", "s.exr"}, 1, "none.binary");
  fails({"reflect", sky, "--brdf", "ggx:0.5", "-o", "s.bmp"}, 1, "s.bmp");
  EXPECT_TRUE(files_below(at("")).empty());
}

}  // namespace
}  // namespace welkin
