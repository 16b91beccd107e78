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

}  // namespace
}  // namespace welkin
