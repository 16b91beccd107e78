#include <algorithm>
#include <cmath>

#include "command_test.h"

#include <welkin/image/load.h>
#include <welkin/realtime/technique.h>

// welkin frame, as a user runs it.

namespace welkin {
namespace {

class FrameCommandTest : public CommandTest {
 protected:
  // A small picture of a small light; returns what is said.
  std::string frame(Arguments arguments) const {
    arguments.insert(arguments.begin(), {"frame", "spheres", "--size", "40x30", "--map-size", "16"});
    return run_well(arguments);
  }
  Image picture(const std::string& name) const { return load_image(at(name)).flat; }
};

const std::string sky = "sky:studio,size=64x32";

TEST_F(FrameCommandTest, WritesPicturesOfTheSizeAskedFor) {
  for (const std::string name : {"f.png", "f.exr"}) {
    frame({"--env", sky, "-o", name});
    const Image written = picture(name);
    EXPECT_EQ(written.width, 40) << name;
    EXPECT_EQ(written.height, 30) << name;
    float largest = 0;
    for (const float value : written.pixels) {
      EXPECT_TRUE(std::isfinite(value)) << name;
      largest = std::max(largest, value);
    }
    EXPECT_GT(largest, 0.1f) << name;  // not black
  }
}

TEST_F(FrameCommandTest, ListsEveryTechnique) {
  const auto list = nlohmann::json::parse(run_well({"frame", "--list", "--json"}));
  const std::string text = "\n" + run_well({"frame", "--list"});
  ASSERT_EQ(list.size(), techniques().size());
  for (std::size_t i = 0; i < techniques().size(); ++i) {
    const std::string name(techniques()[i].name);
    EXPECT_EQ(list[i]["name"], name);
    EXPECT_NE(text.find("\n" + name + "\n"), std::string::npos) << name;
  }
}

TEST_F(FrameCommandTest, TellsErrorsAgainstTheTruthAndWritesIt) {
  const auto report =
      nlohmann::json::parse(frame({"--env", sky, "--technique", "irradiance-map", "--maps", "single",
                                   "--supersample", "2", "--reference", "64", "--json", "-o", "f.exr"}));
  EXPECT_EQ(report["truth"], "unshadowed");
  EXPECT_GT(report["errors"]["pixels"], 300);
  for (const auto& [name, value] : report["errors"].items()) {
    ASSERT_TRUE(value.is_number()) << name;  // what is not finite is null in JSON
    EXPECT_TRUE(std::isfinite(value.get<double>())) << name;
  }
  // The truth's noise, which is the mean of its absolute values, and less than a hundredth by the map itself.
  const double noise = report["errors"]["truth_noise"];
  EXPECT_LT(noise, 0.1);
  EXPECT_LT(report["errors"]["mean_absolute"], noise + 0.01);
  EXPECT_EQ(picture("f-truth.exr").width, 40);
  EXPECT_TRUE(std::filesystem::exists(at("f-difference.png")));
}

// The same light by its folder and by its name, but for the codes of the folder's files and its cubes' sizes.
TEST_F(FrameCommandTest, TakesAFolderOfIbl) {
  run_well({"ibl", sky, "-o", "set", "--size", "16", "--irradiance-size", "16", "--dfg-size", "16"});
  for (const std::string technique : {"irradiance-map", "prefiltered-ggx"}) {
    frame({"--env", "set", "--technique", technique, "-o", "folder.exr"});
    frame({"--env", sky, "--technique", technique, "-o", "name.exr"});
    const Image a = picture("folder.exr"), b = picture("name.exr");
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    double difference = 0, sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      difference += std::abs(double{a.pixels[i]} - double{b.pixels[i]});
      sum += std::abs(double{b.pixels[i]});
    }
    EXPECT_LT(difference / sum, 0.05) << technique;
  }
}

TEST_F(FrameCommandTest, RefusesInOneLineAndWritesNothing) {
  expect_refused({"frame", "spheres", "-o", "f.png", "--technique", "nothing"}, 2,
                 "there is no technique nothing");
  expect_refused({"frame", "spheres", "-o", "f.png", "--technique", "mirror:x=1"}, 2, "has no parameter x");
  expect_refused({"frame", "spheres", "-o", "f.png", "--technique", "dynamic-irradiance:size=big"}, 2,
                 "size=big");
  expect_refused({"frame", "spheres", "-o", "f.png", "--size", "0x30"}, 2, "--size");
  expect_refused({"frame", "spheres", "-o", "f.png", "--size", "wide"}, 2, "--size");
  expect_refused({"frame", "spheres"}, 2, "--output");
  expect_refused({"frame", "spheres", "-o", "f.gif"}, 1, "f.gif");
  expect_refused({"frame", "spheres", "-o", "f.png", "--env", "missing.hdr"}, 1, "missing.hdr");
  expect_refused({"frame", "spheres", "-o", "f.png", "--reference", "0"}, 2, "samples");
}

}  // namespace
}  // namespace welkin
