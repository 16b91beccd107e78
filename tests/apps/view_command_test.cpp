#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include <welkin/image/codecs/ldr.h>
#include <welkin/image/load.h>

#include "run_command.h"

// The window, on a display without a screen (xvfb) and without any display.

namespace welkin {
namespace {

struct ViewRun {
  int exit_code = -1;
  std::string err;
};

ViewRun run_shell(const std::filesystem::path& folder, const std::string& prefix,
                  const std::string& arguments) {
  const std::string err = (folder / "stderr.txt").string();
  const std::string command = "cd '" + folder.string() + "' && " + prefix + " '" + WELKIN_COMMAND +
                              "' view " + arguments + " >stdout.txt 2>'" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(err)};
}

ViewRun run_on_display(const std::filesystem::path& folder, const std::string& arguments) {
  return run_shell(folder, "timeout 300 xvfb-run -a -s '-screen 0 800x600x24'", arguments);
}

std::size_t colours_of(const Image& image, int x0, int x1) {
  std::set<std::array<float, 3>> colours;
  for (int y = 0; y < image.height; ++y)
    for (int x = x0; x < x1; ++x) {
      const float* p = image.at(x, y);
      colours.insert({p[0], p[1], p[2]});
    }
  return colours.size();
}

TEST(ViewCommand, WithoutADisplayNamesTheHeadlessWay) {
  const TemporaryFolder folder;
  const ViewRun run = run_shell(folder.path(), "env -u DISPLAY -u WAYLAND_DISPLAY", "--frames 1");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(line_count(run.err), 1u) << run.err;
  EXPECT_NE(run.err.find("welkin frame"), std::string::npos) << run.err;
}

TEST(ViewCommand, WrongUsageIsOneLineAndNeedsNoDisplay) {
  const TemporaryFolder folder;
  for (const char* arguments : {"--technique nothing", "--size 5x5", "--compare sideways",
                                "--exposure bright", "a.hdr --env b.hdr", "--frames -1"}) {
    const ViewRun run = run_shell(folder.path(), "env -u DISPLAY -u WAYLAND_DISPLAY", arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(line_count(run.err), 1u) << run.err;
  }
  EXPECT_EQ(run_shell(folder.path(), "env -u DISPLAY", "--help").exit_code, 0);
  EXPECT_NE(read_text(folder.path() / "stdout.txt").find("--technique"), std::string::npos);
}

TEST(ViewCommand, ShowsTwoTechniquesSideBySideAndLeaves) {
  const TemporaryFolder folder;
  const ViewRun run = run_on_display(
      folder.path(),
      "--scene spheres --technique mirror --against irradiance-map --size 700x300 --map-size 32 "
      "--screenshot w.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Image window = load_image(folder.path() / "w.png").flat;
  ASSERT_EQ(window.width, 700);
  ASSERT_EQ(window.height, 300);
  EXPECT_GT(colours_of(window, 0, 320), 8u);      // the panel
  EXPECT_GT(colours_of(window, 340, 510), 200u);  // mirrors
  EXPECT_GT(colours_of(window, 540, 700), 30u);   // smooth shades
}

TEST(ViewCommand, TracesTheTruthOfAScene) {
  const TemporaryFolder folder;
  const ViewRun run =
      run_on_display(folder.path(),
                     "--technique irradiance-map --against truth --compare difference --truth-samples 8 "
                     "--size 430x120 --map-size 32 --screenshot w.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(load_image(folder.path() / "w.png").flat.width, 430);
}

// Half of a window that is narrower than the panel is left for the picture: without one nothing could settle.
TEST(ViewCommand, ANarrowWindowHasAPictureAndATruthOfOcclusion) {
  const TemporaryFolder folder;
  const ViewRun run = run_on_display(folder.path(),
                                     "--technique ssao-range --against truth --truth-samples 8 --size 240x60 "
                                     "--map-size 16 --screenshot w.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_GT(colours_of(load_image(folder.path() / "w.png").flat, 125, 240), 20u);
}

// A light that a technique captures itself is the truth's light too.
TEST(ViewCommand, TracesTheTruthOfADynamicTechnique) {
  const TemporaryFolder folder;
  const ViewRun run =
      run_on_display(folder.path(),
                     "--technique dynamic-irradiance:size=16 --against truth --truth-samples 8 "
                     "--no-panel --size 80x60 --map-size 16 --screenshot w.png");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(load_image(folder.path() / "w.png").flat.width, 80);
}

// A driver of OpenGL ES 3.0, as Mesa pretends to have here, has no compute shaders.
TEST(ViewCommand, AScriptWhoseFirstPictureFailsLeavesWithTheError) {
  const TemporaryFolder folder;
  const ViewRun run = run_shell(
      folder.path(), "MESA_GLES_VERSION_OVERRIDE=3.0 timeout 300 xvfb-run -a -s '-screen 0 800x600x24'",
      "--technique dynamic-irradiance:projection=compute --no-panel --size 80x60 --map-size 16 "
      "--frames 2 --screenshot w.png");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(line_count(run.err), 1u) << run.err;
  EXPECT_NE(run.err.find("compute shaders"), std::string::npos) << run.err;
}

// A program that says what it was given stands beside a copy of welkin in place of the window.
TEST(ViewCommand, PassesThreadsOn) {
  const TemporaryFolder folder;
  std::filesystem::copy_file(WELKIN_COMMAND, folder.path() / "welkin");
  write_text(folder.path() / "welkin-view", "#!/bin/sh\necho \"$@\"\n");
  std::filesystem::permissions(folder.path() / "welkin-view", std::filesystem::perms::owner_all);
  const auto said = [&](const std::string& arguments) {
    const std::string in = "cd '" + folder.path().string() + "' && ";
    EXPECT_EQ(std::system((in + "./welkin " + arguments + " >said.txt").c_str()), 0);
    return read_text(folder.path() / "said.txt");
  };
  EXPECT_EQ(said("--threads 3 view a.hdr"), "--threads 3 a.hdr\n");
  EXPECT_EQ(said("view a.hdr --threads 2"), "a.hdr --threads 2\n");
  EXPECT_EQ(said("view a.hdr"), "a.hdr\n");
}

// The window stays; what a script started reports what was wrong in the end.
TEST(ViewCommand, AFileThatCannotBeReadIsShownAndReported) {
  const TemporaryFolder folder;
  write_text(folder.path() / "broken.glb", "glTF but not really");
  const ViewRun run =
      run_on_display(folder.path(), "broken.glb --size 430x100 --map-size 16 --frames 2 --screenshot w.png");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_EQ(line_count(run.err), 1u) << run.err;
  EXPECT_NE(run.err.find("broken.glb"), std::string::npos) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "w.png"));
}

}  // namespace
}  // namespace welkin
