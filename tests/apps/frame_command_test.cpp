#include <algorithm>
#include <cmath>

#include "command_test.h"

#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/output_file.h>

// welkin frame, as a user runs it.

namespace welkin {
namespace {

class FrameCommandTest : public CommandTest {
 protected:
  nlohmann::json frame(Arguments arguments) const {
    arguments.insert(arguments.begin(), "frame");
    for (const char* more :
         {"--env", "sky:studio,size=64x32", "--map-size", "32", "--size", "40x30", "--json"})
      arguments.push_back(more);
    return nlohmann::json::parse(run_well(arguments));
  }
};

TEST_F(FrameCommandTest, TellsErrorsAndWritesTruthDifferenceAndSheet) {
  const auto report = frame({"spheres", "--technique", "irradiance-map", "--maps", "single", "--supersample",
                             "2", "--reference", "64", "--sheet", "s.jpg", "--times", "2", "-o", "f.exr"});
  EXPECT_EQ(report["truth"], "unshadowed");
  EXPECT_GT(report["errors"]["pixels"], 300);
  EXPECT_LT(report["errors"]["mean_absolute"], 0.05);  // 2 % is the noise of 64 samples
  EXPECT_EQ(report["milliseconds"].back()["pass"], "frame");
  EXPECT_EQ(files_below(at("")).size(), 4u);
  EXPECT_TRUE(read_text(at("s.jpg")).starts_with("\xff\xd8"));
  const ExrLayers layers = decode_exr_layers(read_file(at("f.exr")), "f.exr");
  ASSERT_EQ(layers.layers.size(), 1u);
  EXPECT_EQ(layers.layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
}

TEST_F(FrameCommandTest, ComparesWithAFileOfRender) {
  run_well({"render", "spheres", "--env", "sky:studio,size=64x32", "--integrator", "direct", "--no-shadows",
            "--size", "40x30", "--spp", "64", "-o", "truth.exr"});
  const auto report = frame({"spheres", "--supersample", "2", "--reference", "truth.exr", "-o", "f.png"});
  EXPECT_GT(report["errors"]["pixels"], 300);
  EXPECT_LT(report["errors"]["mean_absolute"], 0.3);
}

TEST_F(FrameCommandTest, ListsTechniquesForProgramsAndPeople) {
  const auto list = nlohmann::json::parse(run_well({"frame", "--list", "--json"}));
  ASSERT_GT(list.size(), 3u);
  EXPECT_EQ(list[0]["name"], "mirror");
  EXPECT_NE(run_well({"frame", "--list"}).find("\nprefiltered-ggx\n"), std::string::npos);
}

TEST_F(FrameCommandTest, WritesWholeShaders) {
  frame({"spheres", "--technique", "mirror", "--shaders", "glsl", "-o", "f.png"});
  const std::string text = read_text(at("glsl/mirror.frag"));
  EXPECT_TRUE(text.starts_with("#version 300 es\n"));
  EXPECT_NE(text.find("const float PI"), std::string::npos);
  EXPECT_EQ(text.find("#include"), std::string::npos);
}

TEST_F(FrameCommandTest, RefusesInOneLine) {
  expect_refused({"frame", "spheres", "-o", "f.png", "--technique", "nothing"}, 2,
                 "there is no technique nothing");
  expect_refused({"frame", "spheres", "-o", "f.png", "--technique", "mirror:x=1"}, 2, "has no parameter x");
  expect_refused({"frame", "spheres"}, 2, "--output");
  expect_refused({"frame", "-o", "f.png"}, 2, "scene");
  expect_refused({"frame", "spheres", "-o", "f.gif"}, 1, "f.gif");
  expect_refused({"frame", "spheres", "-o", "f.png", "--env", "none"}, 2, "--env");
  expect_refused({"frame", "spheres", "-o", "f.png", "--sheet", "s.png"}, 2, "--reference");
  expect_refused({"frame", "spheres", "-o", "f.png", "--reference", "0"}, 2, "samples");
  expect_refused({"frame", "spheres", "-o", "f.png", "--reference", "none.exr"}, 1, "none.exr");
  expect_refused({"render", "spheres", "-o", "f.exr", "--no-shadows"}, 2, "--no-shadows");
}

}  // namespace
}  // namespace welkin
