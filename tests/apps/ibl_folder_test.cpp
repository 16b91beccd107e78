#include <welkin/realtime/ibl_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "run_command.h"

#include <welkin/brdf/dfg.h>
#include <welkin/error.h>

// What the renderer makes of the sets that `welkin ibl` writes, against what the command was asked for.

namespace welkin {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> small = {"--size", "16", "--irradiance-size", "8", "--dfg-size", "16"};

fs::path write_set_with(const TemporaryFolder& folder, const std::string& name,
                        std::vector<std::string> arguments, const std::string& sky = "sky:studio") {
  arguments.insert(arguments.begin(), {"ibl", sky, "-o", name});
  arguments.insert(arguments.end(), small.begin(), small.end());
  RunOptions options;
  options.folder = folder.path();
  const RunResult result = run_welkin(arguments, options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return folder.path() / name;
}

double mean_of(const Cube& cube) {
  double sum = 0;
  for (const float v : cube.texels) sum += static_cast<double>(v);
  return sum / static_cast<double>(cube.texels.size());
}

// Two sets of the same sky in other containers and formats are the same to rounding: halves 2^-11, BC6H a few per cent a texel.
TEST(IblFolder, EveryContainerAndFormatGivesTheSameLight) {
  const TemporaryFolder folder;
  const IblFolder plain = load_ibl_folder(write_set_with(folder, "plain", {"--format", "rgba32f"}));
  const double specular = mean_of(plain.light->maps.specular.levels[1]);
  ASSERT_GT(specular, 0);
  struct Case {
    std::vector<std::string> arguments;
    double tolerance;
  };
  const Case cases[] = {{{}, 1e-3},
                        {{"--container", "dds"}, 1e-3},
                        {{"--container", "exr"}, 1e-3},
                        {{"--format", "bc6h"}, 3e-2},
                        {{"--format", "astc"}, 3e-2},
                        {{"--format", "bc6h", "--container", "dds"}, 3e-2}};
  int number = 0;
  for (const Case& c : cases) {
    const IblFolder other =
        load_ibl_folder(write_set_with(folder, "set" + std::to_string(number++), c.arguments));
    EXPECT_TRUE(other.warnings.empty());
    EXPECT_EQ(other.light->maps.specular.levels.size(), plain.light->maps.specular.levels.size());
    EXPECT_NEAR(mean_of(other.light->maps.specular.levels[1]), specular, c.tolerance * specular) << number;
    EXPECT_NEAR(mean_of(other.light->maps.irradiance), mean_of(plain.light->maps.irradiance),
                c.tolerance * mean_of(plain.light->maps.irradiance))
        << number;
    EXPECT_NEAR(mean_of(other.light->maps.environment.levels[0]),
                mean_of(plain.light->maps.environment.levels[0]),
                c.tolerance * mean_of(plain.light->maps.environment.levels[0]))
        << number;
  }
}

// The irradiance map is E: pi times the mean radiance, over all normals. The picture made from the cube has its energy.
TEST(IblFolder, TheMapsBelongTogether) {
  const TemporaryFolder folder;
  const IblFolder loaded = load_ibl_folder(write_set_with(folder, "set", {}));
  const double dc =
      loaded.light->maps.radiance_sh.values[0] / std::sqrt(4 * std::numbers::pi);  // mean radiance
  const ShCoefficients again = project_equirect(loaded.light->radiance, 2);
  EXPECT_NEAR(again.values[0] / loaded.light->maps.radiance_sh.values[0], 1, 2e-3);
  EXPECT_NEAR(mean_of(loaded.light->maps.irradiance) / (std::numbers::pi * dc), 1,
              0.1);  // corners count too much
  EXPECT_EQ(loaded.light->maps.environment.levels.size(), 5u);
}

TEST(IblFolder, LevelLawAndDfgTableAreWhatTheManifestSays) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_ibl_folder(write_set_with(folder, "a", {})).light->law, LevelLaw::linear);
  EXPECT_EQ(load_ibl_folder(write_set_with(folder, "b", {"--level-law", "quadratic"})).light->law,
            LevelLaw::quadratic);
  EXPECT_EQ(load_ibl_folder(write_set_with(folder, "c", {"--level-law", "log2"})).light->law,
            LevelLaw::logarithmic);
  const IblFolder whole = load_ibl_folder(write_set_with(folder, "d", {"--dfg-multiple-scattering"}));
  const DfgTable single = make_dfg_table({16});
  EXPECT_EQ(whole.light->maps.dfg.scale_bias, single.scale_bias);
}

std::string refusal(const fs::path& folder) {
  try {
    load_ibl_folder(folder);
  } catch (const Error& error) {
    return error.what();
  }
  return "not refused";
}

TEST(IblFolder, WhatTheRendererCannotLookUpIsRefused) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(write_set_with(folder, "phong", {"--kernel", "phong"})).find("the kernel phong"),
            std::string::npos);
  EXPECT_NE(refusal(write_set_with(folder, "warp", {"--edge-fixup", "warp"})).find("warp"),
            std::string::npos);
  EXPECT_NE(refusal(write_set_with(folder, "one", {"--levels", "1"})).find("one level"), std::string::npos);
  EXPECT_NE(refusal(folder.path() / "nowhere").find("cannot be read"), std::string::npos);
  fs::create_directories(folder.path() / "broken");
  write_text(folder.path() / "broken" / "manifest.json", "{\"files\": 3}");
  EXPECT_NE(refusal(folder.path() / "broken").find("lacks a field"), std::string::npos);
  EXPECT_FALSE(is_ibl_folder(folder.path()));
  EXPECT_TRUE(is_ibl_folder(folder.path() / "phong"));
}

TEST(IblFolder, LightsThatWereTakenOutAreWarnedOf) {
  const TemporaryFolder folder;
  const fs::path set = write_set_with(folder, "set", {"--extract-sun"}, "sky:day");
  const IblFolder loaded = load_ibl_folder(set);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("lights were taken out"), std::string::npos);
}

}  // namespace
}  // namespace welkin
