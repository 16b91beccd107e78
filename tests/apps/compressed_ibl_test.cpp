#include <algorithm>
#include <cmath>

#include "command_test.h"
#include "ibl_set.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/ibl.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/sphere/cube_edge_fixup.h>

// welkin ibl and convert with block formats and with edges fixed for samplers that clamp to faces.

namespace welkin {
namespace {

using CompressedIblTest = CommandTest;

const std::vector<std::string> small{"--size", "16", "--irradiance-size", "8", "--dfg-size", "8"};
constexpr const char* sky = "sky:overcast,size=64x32";

std::vector<std::string> ibl(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"ibl", sky, "-o", "out"};
  arguments.insert(arguments.end(), small.begin(), small.end());
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

IblSet library_set() {
  IblOptions options;
  options.size = 16;
  options.irradiance_size = 8;
  options.dfg_size = 8;
  return make_ibl(load_environment(sky).radiance, options);
}

double relative_rms(const CubeMips& a, const CubeMips& truth) {
  double error = 0, norm = 0;
  EXPECT_EQ(a.levels.size(), truth.levels.size());
  for (std::size_t k = 0; k < truth.levels.size(); ++k)
    for (std::size_t i = 0; i < truth.levels[k].texels.size(); ++i) {
      const double t = truth.levels[k].texels[i], d = a.levels.at(k).texels.at(i) - t;
      error += d * d;
      norm += t * t;
    }
  return std::sqrt(error / norm);
}

struct Packing {
  std::string container, format, quality;
};

class CompressedPackingTest : public CommandTest, public testing::WithParamInterface<Packing> {};

// Steps of the end points are 3 % in the coarsest modes, half of that on smooth blocks; the horizon of this sky is the
// only edge.
TEST_P(CompressedPackingTest, FilesHoldTheSetAndSaySo) {
  const Packing& p = GetParam();
  run_well(ibl({"--container", p.container, "--format", p.format, "--quality", p.quality}));
  expect_complete(at("out"));
  const LoadedSet set = load_set(at("out"));
  const IblSet truth = library_set();
  EXPECT_LT(relative_rms(set.specular, truth.specular), 0.02);
  EXPECT_LT(relative_rms(set.environment, truth.environment), 0.02);
  EXPECT_LT(relative_rms(set.irradiance, CubeMips{{truth.irradiance}}), 0.02);
  for (const auto& file : set.manifest["files"]) {
    const std::string name = file["name"];
    const bool cube = file.value("level_count", 0) > 0 && !name.starts_with("dfg");
    EXPECT_EQ(file["format"] == p.format, cube) << name;
    EXPECT_EQ(file.contains("quality"), cube && p.format != "r11g11b10f") << name;
  }
  EXPECT_EQ(set.manifest["edges"]["fixup"], "none");
}

class StoredErrorsTest : public CommandTest, public testing::WithParamInterface<Packing> {};

// The errors in the manifest are those of the files: measured again here, from the texels that were read.
TEST_P(StoredErrorsTest, AreThoseOfTheFiles) {
  const Packing& p = GetParam();
  const std::string out = run_well(ibl({"--container", p.container, "--format", p.format, "--quality",
                                        p.quality, "--verify", "--verify-directions", "4"}));
  EXPECT_NE(out.find("after writing as " + p.format), std::string::npos) << out;
  const LoadedSet set = load_set(at("out"));
  const IblSet truth = library_set();
  for (std::size_t k = 0; k < truth.levels.size(); ++k) {
    const double expected =
        relative_rms(CubeMips{{set.specular.levels[k]}}, CubeMips{{truth.specular.levels[k]}});
    const auto& stored = set.manifest["levels"][k]["stored_errors"];
    EXPECT_NEAR(stored["relative_rms"], expected, 1e-6 + 1e-3 * expected) << k;
    EXPECT_LT(std::abs(stored["energy"].get<double>()), 0.02) << k;
  }
  EXPECT_GT(set.manifest["irradiance"]["stored_errors"]["relative_rms"], 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, CompressedPackingTest,
    testing::Values(Packing{"ktx2", "bc6h", "fast"}, Packing{"ktx2", "bc6h", "high"},
                    Packing{"ktx2", "astc", "fast"}, Packing{"ktx2", "astc6x6", "normal"},
                    Packing{"ktx2", "r11g11b10f", "fast"}, Packing{"dds", "bc6h", "normal"},
                    Packing{"dds", "r11g11b10f", "normal"}),
    [](const auto& instance) {
      return instance.param.container + "_" + instance.param.format + "_" + instance.param.quality;
    });

INSTANTIATE_TEST_SUITE_P(All, StoredErrorsTest,
                         testing::Values(Packing{"ktx2", "astc6x6", "fast"}, Packing{"dds", "bc6h", "fast"},
                                         Packing{"exr", "rgba16f", "fast"}),
                         [](const auto& instance) {
                           return instance.param.container + "_" + instance.param.format;
                         });

TEST_F(CompressedIblTest, FormatsThatAContainerLacksAreRefused) {
  for (const Arguments& wrong : {Arguments{"--container", "dds", "--format", "astc"},
                                 {"--container", "dds", "--format", "astc6x6"},
                                 {"--container", "exr", "--format", "bc6h"},
                                 {"--container", "exr", "--format", "r11g11b10f"},
                                 {"--format", "bc6h_signed"},
                                 {"--format", "rg16f"},
                                 {"--quality", "best"},
                                 {"--edge-fixup", "seamless"}}) {
    const RunResult result = run(ibl(wrong));
    EXPECT_EQ(result.exit_code, 2) << testing::PrintToString(wrong);
    EXPECT_FALSE(std::filesystem::exists(at("out")));
  }
  EXPECT_EQ(run({"convert", sky, "-o", "a.dds", "--format", "astc"}).exit_code, 2);
}

TEST_F(CompressedIblTest, ZstandardCompressesBlocksToo) {
  run_well(ibl({"--format", "bc6h", "--zstd", "9"}));
  EXPECT_LT(relative_rms(load_set(at("out")).specular, library_set().specular), 0.02);
}

// Both faces hold the same texels along an edge, so the stored step is that of float rounding in the look-up.
TEST_F(CompressedIblTest, FixedEdgesAreWrittenAndNamed) {
  for (const std::string fixup : {"warp", "average"}) {
    run_well(ibl({"--format", "rgba32f", "--edge-fixup", fixup}));
    const LoadedSet set = load_set(at("out"));
    const EdgeFixup kind = edge_fixup_from_name(fixup).value();
    const IblSet truth = library_set();
    EXPECT_EQ(relative_rms(set.specular, fix_edges(truth.specular, kind)), 0) << fixup;
    EXPECT_EQ(relative_rms(set.irradiance, fix_edges(CubeMips{{truth.irradiance}}, kind)), 0) << fixup;
    EXPECT_EQ(set.manifest["edges"]["fixup"], fixup);
    for (const Cube& level : set.specular.levels) EXPECT_LT(face_edge_step(level, kind), 1e-6) << fixup;
    const std::string bytes = read_text(at("out/specular.ktx2"));
    const auto keys =
        read_ktx2_keys({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "s");
    EXPECT_EQ(keys.at("WelkinEdgeFixup"), fixup);
    const RunResult info = run({"info", "out/environment.ktx2"});
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_EQ(info.err.find("warped") != std::string::npos, fixup == "warp") << info.err;
  }
}

// Blocks are made so that the faces agree after decoding: exactly but in the corner blocks of levels of 8 and more.
// A quarter of the edge of size 32 lies in corner blocks; 1 % of the value there is half of what blocks coded apart show.
TEST_F(CompressedIblTest, Bc6hKeepsFixedEdges) {
  for (const std::string container : {"ktx2", "dds"}) {
    run_well({"ibl", sky, "-o", "out", "--size", "32", "--irradiance-size", "8", "--dfg-size", "8",
              "--format", "bc6h", "--edge-fixup", "average", "--container", container});
    const LoadedSet set = load_set(at("out"));
    const Cube& cube = set.specular.levels[1];
    for (int y = 4; y < cube.size - 4; ++y)
      for (int c = 0; c < 3; ++c)  // +Z's last column touches +X's first
        EXPECT_EQ(cube.at(4, cube.size - 1, y)[c], cube.at(0, 0, y)[c]) << container << y;
    EXPECT_LT(face_edge_step(cube, EdgeFixup::average), 0.01) << container;
  }
}

TEST_F(CompressedIblTest, ConvertWritesAndReadsBlocks) {
  run_well({"convert", sky, "--to", "cube", "--size", "16", "--format", "rgba32f", "-o", "plain.ktx2"});
  for (const std::string format : {"bc6h", "bc6h_signed", "astc", "astc6x6", "r11g11b10f"}) {
    run_well({"convert", sky, "--to", "cube", "--size", "16", "--format", format, "-o", "packed.ktx2"});
    const auto compared = nlohmann::json::parse(run_well({"compare", "packed.ktx2", "plain.ktx2", "--json"}));
    EXPECT_LT(compared["parts"][0]["relative_rmse"], 0.02) << format;
    EXPECT_GT(compared["parts"][0]["relative_rmse"], 0) << format;
    run_well({"info", "packed.ktx2"});
    run_well({"ibl", "packed.ktx2", "-o", "again", "--size", "8"});
  }
}

}  // namespace
}  // namespace welkin
