#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "command_test.h"
#include "ibl_set.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/ibl.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>
#include <welkin/sphere/cube.h>

// welkin ibl: what it writes is what the library computes, in every container and format, and every number in the
// manifest is true.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
using IblCommandTest = CommandTest;

double luminance(const double* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// The library's result for the same options: the truth for what the files hold.
IblSet library_set(const std::string& input, int size, int irradiance_size = 64, int dfg_size = 128) {
  IblOptions options;
  options.size = size;
  options.irradiance_size = irradiance_size;
  options.dfg_size = dfg_size;
  return make_ibl(load_environment(input).radiance, options);
}

double file_member(const LoadedSet& set, const std::string& prefix, const std::string& member) {
  for (const auto& file : set.manifest["files"])
    if (file["name"].get<std::string>().starts_with(prefix)) return file[member];
  ADD_FAILURE() << "no file " << prefix;
  return 0;
}

void expect_files_hold(const LoadedSet& files, const IblSet& truth, const std::string& format) {
  const auto scale = [&](const char* name) { return file_member(files, name, "stored_scale"); };
  expect_rounded(files.environment, truth.environment, format, scale("environment"));
  expect_rounded(files.specular, truth.specular, format, scale("specular"));
  expect_rounded(files.irradiance, CubeMips{{truth.irradiance}}, format, scale("irradiance"));
  ASSERT_EQ(files.dfg.width, truth.dfg.size);
  for (int i = 0; i < truth.dfg.size * truth.dfg.size; ++i) {
    // Halves of numbers below 1.5: 2^-11. In single floats the difference is 0.
    const double allowed = format == "rgba32f" ? 0 : std::exp2(-11);
    for (int c = 0; c < 2; ++c)
      ASSERT_NEAR(files.dfg.pixels[3 * i + c], truth.dfg.scale_bias[2 * i + c], allowed);
  }
}

// The nine functions written out as sh.json names them, times the cosine lobe's pi, 2 pi / 3, pi / 4.
void irradiance_of(const nlohmann::json& coefficients, Vec3 n, double* rgb) {
  const double basis[9] = {0.282095,
                           0.488603 * n.y,
                           0.488603 * n.z,
                           0.488603 * n.x,
                           1.092548 * n.x * n.y,
                           1.092548 * n.y * n.z,
                           0.315392 * (3 * n.z * n.z - 1),
                           1.092548 * n.x * n.z,
                           0.546274 * (n.x * n.x - n.y * n.y)};
  for (int c = 0; c < 3; ++c) {
    rgb[c] = 0;
    for (int i = 0; i < 9; ++i)
      rgb[c] += (i == 0 ? pi : i < 4 ? 2 * pi / 3 : pi / 4) * basis[i] * coefficients[i][c].get<double>();
  }
}

struct ShError {
  double mean = 0, max = 0;  // of the largest irradiance, as the manifest has them
};

ShError sh_error(const LoadedSet& set) {
  const Cube& cube = set.irradiance.levels.at(0);
  double sum = 0, largest = 0, largest_irradiance = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) {
        double value[3], truth[3], difference[3];
        irradiance_of(set.sh["coefficients"], cube_texel_direction(cube.size, face, x, y), value);
        for (int c = 0; c < 3; ++c) {
          truth[c] = cube.at(face, x, y)[c];
          difference[c] = value[c] - truth[c];
        }
        const double error = std::abs(luminance(difference));
        sum += error * cube_texel_solid_angle(cube.size, x, y) / (4 * pi);
        largest = std::max(largest, error);
        largest_irradiance = std::max(largest_irradiance, luminance(truth));
      }
  return {sum / largest_irradiance, largest / largest_irradiance};
}

TEST_F(IblCommandTest, MakesACompleteMeasuredSet) {
  run_well({"ibl", "sky:day,size=256x128", "-o", "out", "--size", "64", "--verify"});
  expect_complete(at("out"));
  const LoadedSet set = load_set(at("out"));
  expect_files_hold(set, library_set("sky:day,size=256x128", 64), "rgba16f");
  ASSERT_EQ(set.manifest["levels"].size(), static_cast<std::size_t>(default_levels(64)));
  for (std::size_t k = 1; k < set.manifest["levels"].size(); ++k) {
    const auto& errors = set.manifest["levels"][k]["errors"];
    EXPECT_LE(errors["relative_rms"], 1e-4) << "level " << k;   // what the filter promises
    EXPECT_LE(errors["max_over_mean"], 1e-3) << "level " << k;  // likewise
    EXPECT_GT(errors["relative_rms"], 0) << "level " << k;      // a float is never exact
  }
  EXPECT_LE(set.manifest["irradiance"]["errors"]["relative_rms"], 1e-4);
  EXPECT_LE(set.manifest["dfg"]["max_error"], 1e-4);
}

TEST_F(IblCommandTest, CoefficientsGiveTheIrradianceToTheStatedError) {
  run_well({"ibl", "sky:day,size=128x64", "-o", "out", "--size", "16", "--format", "rgba32f", "--verify",
            "--irradiance-size", "16", "--dfg-size", "8", "--verify-directions", "400"});
  const LoadedSet set = load_set(at("out"));
  EXPECT_EQ(set.sh["quantity"], "radiance");
  EXPECT_EQ(set.sh["convention"]["cosine_applied"], false);
  EXPECT_EQ(set.sh["convention"]["condon_shortley_sign"], false);
  ASSERT_EQ(set.sh["coefficients"].size(), 9u);
  // The manifest's figures come from 400 random directions: the mean is off by 1/20 of itself, and the maximum, smooth
  // around its place, by less. 15 % holds both.
  const ShError error = sh_error(set);
  const double mean = set.manifest["sh"]["irradiance_mean_error"],
               max = set.manifest["sh"]["irradiance_max_error"];
  EXPECT_NEAR(error.mean, mean, 0.15 * mean);
  EXPECT_NEAR(error.max, max, 0.15 * max);
  EXPECT_LT(error.max, 0.1);
}

struct Packing {
  std::string container, format;
  std::vector<std::string> more;
};

void PrintTo(const Packing& packing, std::ostream* out) {
  *out << packing.container << ' ' << packing.format;
}

class IblPackingTest : public CommandTest, public testing::WithParamInterface<Packing> {};

// The texel's 200,000 is more than half floats and rgb9e5 hold, so that scales are tested with everything else.
TEST_P(IblPackingTest, FilesHoldTheLibrarysValues) {
  const Packing& packing = GetParam();
  const std::string input = "sky:texel,value=200000:100000:50,size=64x32,x=20,y=9";
  std::vector<std::string> arguments{
      "ibl", input,        "-o", "out",         "--size",          "32",       "--irradiance-size",
      "8",   "--dfg-size", "16", "--container", packing.container, "--format", packing.format};
  arguments.insert(arguments.end(), packing.more.begin(), packing.more.end());
  run_well(arguments);
  expect_complete(at("out"));
  const LoadedSet set = load_set(at("out"));
  expect_files_hold(set, library_set(input, 32, 8, 16), packing.format);
  const bool fits = packing.format == "rgba32f";
  EXPECT_EQ(file_member(set, "specular", "stored_scale") > 1, !fits);
  EXPECT_EQ(file_member(set, "specular", "clipped"), 0);
}

INSTANTIATE_TEST_SUITE_P(All, IblPackingTest,
                         testing::Values(Packing{"ktx2", "rgba16f", {}}, Packing{"ktx2", "rgba32f", {}},
                                         Packing{"ktx2", "rgb9e5", {}},
                                         Packing{"ktx2", "rgba16f", {"--zstd", "5"}},
                                         Packing{"dds", "rgba16f", {}}, Packing{"dds", "rgba32f", {}},
                                         Packing{"dds", "rgb9e5", {}}, Packing{"ktx2", "r11g11b10f", {}},
                                         Packing{"exr", "rgba16f", {}}, Packing{"exr", "rgba32f", {}}),
                         [](const auto& instance) {
                           return instance.param.container + "_" + instance.param.format +
                                  (instance.param.more.empty() ? "" : "_zstd");
                         });

class IblConstantTest : public CommandTest, public testing::WithParamInterface<std::string> {};

TEST_P(IblConstantTest, GivesPiLAndL) {
  const std::string format = GetParam();
  run_well({"ibl", "sky:constant,value=3:1:0.3,size=64x32", "-o", "out", "--size", "32", "--irradiance-size",
            "8", "--dfg-size", "8", "--format", format});
  const LoadedSet set = load_set(at("out"));
  const auto expect_constant = [&](const CubeMips& cube, double factor) {
    const double truth[3] = {3 * factor, 1 * factor, 0.3 * factor};
    // 1e-6 is what the filter promises; then the format's own rounding.
    const double allowed = 1e-6 * truth[0] + rounding(format, truth[0], 1);
    for (const Cube& level : cube.levels)
      for (std::size_t i = 0; i < level.texels.size(); ++i)
        ASSERT_NEAR(level.texels[i], truth[i % 3], allowed) << level.size;
  };
  expect_constant(set.environment, 1);
  expect_constant(set.specular, 1);
  expect_constant(set.irradiance, pi);
}

INSTANTIATE_TEST_SUITE_P(Formats, IblConstantTest,
                         testing::Values("rgba32f", "rgba16f", "rgb9e5", "r11g11b10f"),
                         [](const auto& instance) { return instance.param; });

TEST_F(IblCommandTest, AScaleIsNamedEverywhere) {
  const std::string out = run_well({"ibl", "sky:texel,value=200000,size=64x32", "-o", "out", "--size", "32",
                                    "--irradiance-size", "8", "--dfg-size", "8"});
  const LoadedSet set = load_set(at("out"));
  const double scale = file_member(set, "environment", "stored_scale");
  EXPECT_EQ(scale,
            4);  // the first power of two that brings 152,000, the largest mean over a texel, below 65,504
  const auto keys = read_ktx2_keys(read_file(at("out/environment.ktx2")), "environment");
  ASSERT_TRUE(keys.contains("WelkinStoredScale"));
  EXPECT_EQ(std::stod(keys.at("WelkinStoredScale")), scale);
  EXPECT_NE(out.find("note: environment.ktx2 is stored divided by 4"), std::string::npos) << out;
  EXPECT_NE(read_text(at("out/index.html")).find("stored_scale"), std::string::npos);
  const auto& texels = set.environment.levels.at(0).texels;
  EXPECT_GT(*std::max_element(texels.begin(), texels.end()), 65504);
  expect_files_hold(set, library_set("sky:texel,value=200000,size=64x32", 32, 8, 8), "rgba16f");
}

TEST_F(IblCommandTest, ClippingIsCountedAndSaid) {
  const std::string input = "sky:texel,value=200000,size=64x32";
  const std::string out = run_well({"ibl", input, "-o", "out", "--size", "32", "--irradiance-size", "8",
                                    "--dfg-size", "8", "--range", "clip"});
  std::size_t beyond = 0;
  for (const Cube& level : library_set(input, 32, 8, 8).environment.levels)
    beyond += static_cast<std::size_t>(
        std::count_if(level.texels.begin(), level.texels.end(), [](float v) { return v > 65504; }));
  ASSERT_GT(beyond, 0u);
  const LoadedSet set = load_set(at("out"));
  EXPECT_EQ(file_member(set, "environment", "clipped"), beyond);
  EXPECT_EQ(file_member(set, "environment", "stored_scale"), 1);
  EXPECT_NE(out.find("note: " + std::to_string(beyond) + " values of environment.ktx2 were clipped"),
            std::string::npos)
      << out;
}

TEST_F(IblCommandTest, ThreadsDoNotChangeAByte) {
  for (const std::string threads : {"1", "2", "8"})
    run_well({"ibl", "sky:day,size=128x64", "-o", threads, "--size", "32", "--irradiance-size", "16",
              "--dfg-size", "16", "--verify", "--verify-directions", "16", "--zstd", "3", "--threads",
              threads});
  auto one = files_below(at("1"));
  const auto manifest = [](std::map<std::string, std::string>& files) {
    files.erase("index.html");  // shows the times
    return without_times(nlohmann::json::parse(files.extract("manifest.json").mapped()));
  };
  const auto manifest_of_one = manifest(one);
  EXPECT_EQ(one.size(), 6u);
  for (const std::string threads : {"2", "8"}) {
    auto many = files_below(at(threads));
    EXPECT_EQ(manifest(many), manifest_of_one) << threads;
    ASSERT_EQ(many.size(), one.size());
    for (const auto& [name, bytes] : one)
      EXPECT_TRUE(many.at(name) == bytes) << name << ", threads: " << threads;
  }
}

TEST_F(IblCommandTest, JsonPrintsTheManifest) {
  const std::string out = run_well({"ibl", "sky:constant,size=16x8", "-o", "deep/er/out", "--size", "4",
                                    "--levels", "2", "--irradiance-size", "2", "--dfg-size", "4", "--json"});
  EXPECT_EQ(out, read_text(at("deep/er/out/manifest.json")));
}

TEST_F(IblCommandTest, ASecondRunReplacesTheFirst) {
  const auto make = [&](const char* size) {
    run_well({"ibl", "sky:studio,size=16x8", "-o", "out", "--size", size, "--irradiance-size", "2",
              "--dfg-size", "4"});
    expect_complete(at("out"));
    return load_set(at("out")).environment.size();
  };
  EXPECT_EQ(make("8"), 8);
  EXPECT_EQ(make("16"), 16);
}

}  // namespace
}  // namespace welkin
