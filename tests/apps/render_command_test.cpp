#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "command_test.h"

#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/output_file.h>

// welkin render, as a user runs it: what it writes, that it can be stopped and gone on with, what it refuses.

namespace welkin {
namespace {

using namespace std::chrono_literals;
using Arguments = std::vector<std::string>;

const std::string white_sky = "sky:constant,value=1,size=16x8";

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

class RenderCommandTest : public CommandTest {
 protected:
  ExrLayers layers(const std::string& name) const { return decode_exr_layers(read_file(at(name)), name); }
};

const Arguments small{"render", "--scene", "furnace", "--env", white_sky, "--size", "40x30"};

// Lossless spheres in white light: 1 everywhere, within the errors that the picture states. Seven degrees of freedom:
// 10 standard errors are beyond any chance of 3600 values.
TEST_F(RenderCommandTest, FurnaceIsWhiteAndAllLayersAreThere) {
  const std::string out = run_well(with(small, {"--spp", "32", "-o", "f.exr"}));
  EXPECT_NE(out.find("f.exr: 40 x 30, 32 samples a pixel"), std::string::npos) << out;
  EXPECT_NE(out.find("standard error of luminance"), std::string::npos) << out;
  const ExrLayers read = layers("f.exr");
  std::vector<std::string> names;
  for (const ExrLayer& layer : read.layers) names.push_back(layer.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"", "albedo", "coverage", "depth", "normal", "samples", "stderr"}));
  EXPECT_EQ(read.error_degrees_of_freedom, 7);
  const Image &radiance = read.layers[0].image, &error = read.layers[6].image;
  for (std::size_t i = 0; i < radiance.pixels.size(); ++i)
    EXPECT_NEAR(radiance.pixels[i], 1, 10 * error.pixels[i] + 2e-3) << i;  // 1e-3: energy tables
  for (const float samples : read.layers[5].image.pixels) EXPECT_EQ(samples, 32);
  EXPECT_EQ(files_below(at("")).size(), 2u);
  EXPECT_TRUE(read_text(at("f.png")).starts_with("\x89PNG"));
}

TEST_F(RenderCommandTest, SameBytesOnAnyNumberOfThreads) {
  const Arguments job{"render", "--scene",   "spheres", "--size",    "56x16", "--error",
                      "0.2",    "--min-spp", "16",      "--max-spp", "128"};
  run_well(with(job, {"--threads", "1", "-o", "one.exr"}));
  run_well(with(job, {"--threads", "3", "-o", "three.exr"}));
  EXPECT_EQ(read_text(at("one.exr")), read_text(at("three.exr")));
  EXPECT_EQ(read_text(at("one.png")), read_text(at("three.png")));
  run_well(with(job, {"--seed", "1", "-o", "other.exr"}));
  EXPECT_NE(read_text(at("one.exr")), read_text(at("other.exr")));
}

TEST_F(RenderCommandTest, StoppedAndResumedIsTheSamePicture) {
  const Arguments job{"render", "--scene", "plane",         "--size", "64x48",
                      "--spp",  "512",     "--state-every", "0.05"};
  run_well(with(job, {"-o", "whole.exr"}));
  const int ignored = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t process = start_welkin(with(job, {"-o", "part.exr"}), at(""), ignored);
  for (int i = 0; i < 3000 && !std::filesystem::exists(at("part.exr.state")); ++i)
    std::this_thread::sleep_for(10ms);
  ::kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 130);
  ::close(ignored);
  EXPECT_TRUE(std::filesystem::exists(at("part.exr.state")));
  EXPECT_NE(read_text(at("part.exr")), read_text(at("whole.exr")));  // what it had, to look at
  run_well(with(job, {"-o", "part.exr", "--resume"}));
  EXPECT_EQ(read_text(at("part.exr")), read_text(at("whole.exr")));
  EXPECT_EQ(read_text(at("part.png")), read_text(at("whole.png")));
  EXPECT_FALSE(std::filesystem::exists(at("part.exr.state")));
}

TEST_F(RenderCommandTest, KeptStatesGoOnToMoreSamples) {
  run_well(with(small, {"--spp", "32", "-o", "f.exr", "--keep-state"}));
  run_well(with(small, {"--spp", "56", "-o", "f.exr", "--resume"}));
  run_well(with(small, {"--spp", "56", "-o", "whole.exr"}));
  EXPECT_EQ(read_text(at("f.exr")), read_text(at("whole.exr")));
}

TEST_F(RenderCommandTest, StatesOfOtherPicturesAndDamagedOnesAreRefused) {
  run_well(with(small, {"--spp", "8", "-o", "f.exr", "--keep-state"}));
  const auto refused = [&](const Arguments& arguments, const std::string& reason) {
    const auto before = files_below(at(""));
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
    EXPECT_NE(result.err.find("f.exr.state"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
    EXPECT_TRUE(files_below(at("")) == before);
  };
  const Arguments resume{"--spp", "16", "-o", "f.exr", "--resume"};
  refused(with(with(small, resume), {"--seed", "4"}), "another scene, environment");
  refused(with(with(small, resume), {"--bounces", "2"}), "another scene, environment");
  refused(with({"render", "--scene", "spheres", "--env", white_sky, "--size", "40x30"}, resume),
          "another scene");
  refused(with({"render", "--scene", "furnace", "--size", "40x30"}, resume), "another scene");
  refused(with({"render", "--scene", "furnace", "--env", white_sky, "--size", "30x40"}, resume), "40 x 30");
  const std::string whole = read_text(at("f.exr.state"));
  write_text(at("f.exr.state"), whole.substr(0, whole.size() / 2));
  refused(with(small, resume), "cut off or damaged");
  std::string bytes = whole;
  bytes[whole.size() / 2] ^= 1;
  write_text(at("f.exr.state"), bytes);
  refused(with(small, resume), "damaged");
  write_text(at("f.exr.state"), "");
  refused(with(small, resume), "empty");
}

TEST_F(RenderCommandTest, AdaptiveSaysWhatItReached) {
  const std::string out =
      run_well({"render", "--scene", "spheres", "--env", "sky:overcast,size=64x32", "--size", "56x16",
                "--error", "0.05", "--min-spp", "16", "--max-spp", "4096", "-o", "a.exr"});
  EXPECT_NE(out.find("have a relative error of 0.05 or less"), std::string::npos) << out;
  const ExrLayers read = layers("a.exr");
  const auto [least, most] =
      std::minmax_element(read.layers[5].image.pixels.begin(), read.layers[5].image.pixels.end());
  EXPECT_EQ(*least, 16);
  EXPECT_GT(*most, 32);
}

TEST_F(RenderCommandTest, ComparesStrategies) {
  const std::string out =
      run_well({"render", "--scene", "spheres:alphas=0.1/0.5", "--env", "sky:studio,size=64x32", "--size",
                "32x32", "--sampling", "compare", "--spp", "8", "-o", "c.exr"});
  EXPECT_NE(out.find("equal time"), std::string::npos) << out;
  const auto figures = json("c.json");
  ASSERT_EQ(figures["equal_samples"].size(), 4u);
  for (const auto& run : figures["equal_samples"]) {
    EXPECT_EQ(run["samples"], 8);
    EXPECT_EQ(run["relative_rmse"].size(), 4u);
    for (const auto& error : run["relative_rmse"]) EXPECT_GT(error, 0);
  }
  EXPECT_TRUE(std::filesystem::exists(at("c.png")));
}

// Of the same sky and of another one: the z-test tells them apart, the page has all of it.
TEST_F(RenderCommandTest, CompareTestsAgainstStandardErrors) {
  const auto render = [&](const std::string& seed, const std::string& value, const std::string& name) {
    run_well({"render", "--scene", "plane", "--env", "sky:ramp,slope=0.5,offset=1,size=32x16,scale=" + value,
              "--size", "48x32", "--spp", "64", "--seed", seed, "-o", name});
  };
  render("1", "1", "a.exr");
  render("2", "1", "b.exr");
  render("3", "1.1", "brighter.exr");
  const auto equal =
      nlohmann::json::parse(run_well({"compare", "a.exr", "b.exr", "--z-test", "--flip", "--json"}));
  EXPECT_TRUE(equal["z_test"]["equal"]) << equal;
  EXPECT_NEAR(equal["z_test"]["mean_square"], 1, 0.15);
  const auto other =
      nlohmann::json::parse(run_well({"compare", "brighter.exr", "b.exr", "--z-test", "--flip", "--json"}));
  EXPECT_FALSE(other["z_test"]["equal"]);
  EXPECT_GT(other["z_test"]["mean_score"], 10);
  EXPECT_GT(other["perceptual"]["mean"], equal["perceptual"]["mean"]);
  const std::string out =
      run_well({"compare", "a.exr", "b.exr", "--z-test", "--report", "page.html", "--flip-map", "m.png"});
  EXPECT_NE(out.find("equal within their errors"), std::string::npos);
  const std::string page = read_text(at("page.html"));
  EXPECT_NE(page.find("Against their standard errors"), std::string::npos);
  EXPECT_NE(page.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_TRUE(read_text(at("m.png")).starts_with("\x89PNG"));
}

class BadRenderTest : public CommandTest {
 protected:
  void expect_refused(const Arguments& arguments, int exit_code, const std::string& named) const {
    const auto before = files_below(at(""));
    const RunResult result = run_obeying_permissions(arguments);
    const std::string all = testing::PrintToString(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << all << result.err;
    EXPECT_EQ(line_count(result.err), 1u) << all << result.err;
    EXPECT_TRUE(result.err.starts_with("welkin: ")) << all << result.err;
    EXPECT_NE(result.err.find(named), std::string::npos) << all << result.err;
    EXPECT_TRUE(files_below(at("")) == before) << all;
  }
};

TEST_F(BadRenderTest, Options) {
  const auto refused = [&](const Arguments& more, const std::string& named) {
    expect_refused(with({"render", "--scene", "furnace", "--spp", "1", "-o", "f.exr"}, more), 2, named);
  };
  for (const char* size :
       {"0x5", "5x0", "-4x4", "axb", "4", "4x", "4x4x4", "99999x2", "16384x16384", "4.5x4", "nan"})
    refused({"--size", size}, "--size");
  for (const char* stops : {"nan", "inf", "bright", "", "1e9"}) refused({"--exposure", stops}, "--exposure");
  for (const char* point : {"1,2", "1,2,3,4", "nan,0,0", "1,2,inf", "a,b,c", "1;2;3", "1e30,0,0"})
    refused({"--eye", point}, "--eye");
  refused({"--fov", "nan"}, "--fov");
  refused({"--fov", "180"}, "--fov");
  refused({"--fov", "0"}, "--fov");
  refused({"--error", "0.1"}, "--error");  // with --spp
  refused({"--camera", "back"}, "no camera 'back'");
  refused({"--camera", "1"}, "no camera '1'");
  refused({"--sampling", "guess"}, "--sampling");
  refused({"--integrator", "photon"}, "--integrator");
  refused({"--heuristic", "none"}, "--heuristic");
  refused({"--bounces", "-1"}, "--bounces");
  refused({"--env-rotate", "nan"}, "--env-rotate");
  refused({"--watch", "nan"}, "--watch");
  refused({"--clamp", "-1"}, "--clamp");
  refused({"--ao-distance", "nan"}, "--ao-distance");
  refused({"--eye", "1,2,3", "--look-at", "1,2,3"}, "--look-at");
  refused({"scene.glb"}, "either");
}

TEST_F(BadRenderTest, OptionsWithoutEffect) {
  const auto refused = [&](const Arguments& more, const std::string& named) {
    expect_refused(with({"render", "--scene", "furnace", "-o", "f.exr"}, more), 2, named);
  };
  refused({"--spp", "8", "--min-spp", "64"}, "--min-spp");
  refused({"--max-spp", "64"}, "--max-spp");
  refused({"--error", "0.1", "--min-spp", "128", "--max-spp", "64"}, "--min-spp");
  refused({"--ao-distance", "1"}, "--ao-distance");
  refused({"--integrator", "direct", "--bounces", "1"}, "--bounces");
  refused({"--integrator", "ibl", "--clamp", "1"}, "--clamp");
  refused({"--integrator", "ao", "--sampling", "mis"}, "--sampling");
  refused({"--sampling", "bsdf", "--heuristic", "power"}, "--heuristic");
  refused({"--env", "none", "--env-rotate", "90"}, "--env-rotate");
  refused({"--sampling", "compare", "--error", "0.1"}, "--error");
  refused({"--sampling", "compare", "--resume"}, "--resume");
  refused({"--sampling", "compare", "--integrator", "path"}, "--integrator");
}

TEST_F(BadRenderTest, ScenesAndFiles) {
  expect_refused({"render", "-o", "f.exr"}, 2, "either");
  expect_refused({"render", "--scene", "furnace"}, 2, "--output");
  expect_refused({"render", "--scene", "nothing", "-o", "f.exr"}, 2, "nothing");
  expect_refused({"render", "--scene", "spheres:alphas=nan", "-o", "f.exr"}, 2, "alphas");
  expect_refused({"render", "missing.glb", "-o", "f.exr"}, 1, "missing.glb");
  expect_refused({"render", "--scene", "furnace", "--env", "missing.hdr", "-o", "f.exr"}, 1, "missing.hdr");
  expect_refused({"render", "--scene", "furnace", "--env", "sky:purple", "-o", "f.exr"}, 1, "purple");
  expect_refused({"render", "--scene", "furnace", "--error", "nan", "-o", "f.exr"}, 2, "--error");
  expect_refused({"render", "--scene", "furnace", "--spp", "0", "-o", "f.exr"}, 2, "--spp");
}

TEST_F(BadRenderTest, Outputs) {
  const auto refused = [&](const std::string& name, int exit_code, const std::string& named) {
    expect_refused({"render", "--scene", "furnace", "--spp", "1", "--size", "8x6", "-o", name}, exit_code,
                   named);
  };
  refused("", 2, "--output");
  refused("f.png", 2, ".exr");
  refused("no/such/folder/f.exr", 1, "no/such/folder/f.exr");
  std::filesystem::create_directory(at("folder.exr"));
  refused("folder.exr", 1, "folder.exr");
  std::filesystem::create_directory(at("locked"));
  std::filesystem::permissions(at("locked"),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  refused("locked/f.exr", 1, "locked/f.exr");
  std::filesystem::permissions(at("locked"), std::filesystem::perms::owner_all);
}

// The picture and the state beside the output are written too: they replace neither an input nor a folder.
TEST_F(BadRenderTest, WhatIsWrittenBesideTheOutput) {
  run_well({"sky", "--kind", "constant", "--size", "16x8", "-o", "f.png"});
  write_text(at("g.exr.state"), read_text(at("f.png")));
  const Arguments job{"render", "--scene", "furnace", "--spp", "1", "--size", "8x6"};
  expect_refused(with(job, {"--env", "f.png", "-o", "f.exr"}), 1, "f.png");
  expect_refused(with(job, {"--env", "g.exr.state", "-o", "g.exr"}), 1, "g.exr.state");
  std::filesystem::create_directory(at("h.png"));
  expect_refused(with(job, {"-o", "h.exr"}), 1, "h.png");
  std::filesystem::create_directory(at("i.exr.state"));
  expect_refused(with(job, {"-o", "i.exr"}), 1, "i.exr.state");
  EXPECT_TRUE(std::filesystem::exists(at("i.exr.state")));
}

TEST_F(BadRenderTest, SceneOutputs) {
  run_well({"scene", "plane", "-o", "plane.glb"});
  expect_refused({"scene", "plane.glb", "-o", "plane.glb"}, 1, "plane.glb");
  expect_refused({"scene", "plane", "-o", "plane.gltf"}, 2, ".glb");
  expect_refused({"scene", "plane", "-o", "no/plane.glb"}, 1, "no/plane.glb");
}

TEST_F(BadRenderTest, NoLightAtAllIsSaid) {
  const RunResult result =
      run({"render", "--scene", "furnace", "--env", "none", "--spp", "1", "--size", "8x6", "-o", "f.exr"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("warning"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("no light"), std::string::npos) << result.err;
}

TEST_F(BadRenderTest, FullDisk) {
  const RunResult result =
      run({"render", "--scene", "furnace", "--spp", "1", "--size", "80x60", "-o", "f.exr"}, 20000);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("f.exr"), std::string::npos) << result.err;
  EXPECT_TRUE(files_below(at("")).empty());
}

TEST_F(BadRenderTest, Compare) {
  run_well({"sky", "--kind", "constant", "--size", "16x8", "-o", "flat.exr"});
  expect_refused({"compare", "flat.exr", "flat.exr", "--z-test"}, 1, "stderr");
  expect_refused({"compare", "flat.exr", "flat.exr", "--report", "page.txt"}, 2, "--report");
  expect_refused({"compare", "flat.exr", "flat.exr", "--flip-map", "m.exr"}, 2, "--flip-map");
  expect_refused({"compare", "flat.exr", "flat.exr", "--flip", "--pixels-per-degree", "nan"}, 2,
                 "--pixels-per-degree");
  expect_refused({"compare", "flat.exr", "flat.exr", "--report", "no/page.html"}, 1, "no/page.html");
  expect_refused({"compare", "flat.exr", "flat.exr", "--diff", "d.png", "--report", "no/page.html"}, 1,
                 "no/page.html");
  expect_refused({"compare", "flat.exr", "flat.exr", "--diff", "d.png", "--z-test"}, 1, "stderr");
  expect_refused({"compare", "flat.exr", "flat.exr", "--diff", "d.png", "--flip-map", "d.png"}, 2,
                 "--flip-map");
}

}  // namespace
}  // namespace welkin
