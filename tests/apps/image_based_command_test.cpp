#include "command_test.h"

namespace welkin {
namespace {

using ImageBasedCommandTest = CommandTest;

TEST_F(ImageBasedCommandTest, RendersAsAnEngineShades) {
  run_well({"render", "--scene", "furnace", "--env", "sky:constant,value=1,size=32x16", "--integrator", "ibl",
            "--spp", "16", "--size", "24x12", "-o", "ibl.exr"});
  EXPECT_TRUE(std::filesystem::exists(at("ibl.exr")));
  const RunResult dark =
      run({"render", "--scene", "furnace", "--env", "none", "--integrator", "ibl", "-o", "x.exr"});
  EXPECT_EQ(dark.exit_code, 1);
  EXPECT_NE(dark.err.find("--integrator ibl shades by an environment"), std::string::npos) << dark.err;
}

// Both spellings of the option, and a built-in scene named where a file could stand.
TEST_F(ImageBasedCommandTest, ShadingIsTheIntegratorAndNamesAreScenes) {
  const std::vector<std::string> job{
      "--env", "sky:constant,value=1,size=32x16", "--spp", "8", "--size", "24x12", "-o"};
  const auto render = [&](std::vector<std::string> arguments, const std::string& output) {
    arguments.insert(arguments.end(), job.begin(), job.end());
    arguments.push_back(output);
    run_well(arguments);
    return read_text(at(output));
  };
  const std::string a = render({"render", "spheres", "--shading", "ibl"}, "a.exr");
  EXPECT_EQ(a, render({"render", "--scene", "spheres", "--integrator", "ibl"}, "b.exr"));
  EXPECT_NE(a, render({"render", "spheres"}, "c.exr"));
  const RunResult missing = run({"render", "sphere", "--spp", "8", "-o", "d.exr"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("spheres"), std::string::npos) << missing.err;  // the names to choose from
}

}  // namespace
}  // namespace welkin
