#include <cmath>
#include <fstream>

#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>

#include "command_test.h"

// welkin brdf, and the stacks that welkin reflect writes.

namespace welkin {
namespace {

using BrdfCommandTest = CommandTest;

TEST_F(BrdfCommandTest, LambertReflectsItsAlbedoFromEverywhere) {
  const auto json = nlohmann::json::parse(run_well({"brdf", "lambert:0.5", "--json"}));
  EXPECT_NEAR(json["greatest_value"].get<double>(), 0.5 / std::acos(-1.0), 1e-12);
  EXPECT_EQ(json["reciprocity_error"], 0.0);
  ASSERT_EQ(json["views"].size(), 12u);
  for (const auto& view : json["views"])  // the fit's rings of 32 points cut the horizon: 1.4e-4 measured
    EXPECT_NEAR(view["directional_albedo"][1].get<double>(), 0.5, 5e-4);
}

TEST_F(BrdfCommandTest, WritesAndReadsTheLayoutOfMerl) {
  const std::string table = run_well({"brdf", "phong:5,0.5", "-o", "p.binary"});
  EXPECT_NE(table.find("directional albedo"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(at("p.binary")), 12u + 8u * 3 * 90 * 90 * 180);
  const auto json = nlohmann::json::parse(run_well({"brdf", "merl:p.binary", "--json"}));
  // Phong 5 at normal view reflects its scale; cells of a degree and a half smooth it.
  EXPECT_NEAR(json["views"][0]["directional_albedo"][0].get<double>(), 0.5, 0.01);
}

TEST_F(BrdfCommandTest, SamplesABrdf) {
  const Arguments arguments{"brdf", "ggx:0.3,1,compensated", "--sampling", "--samples", "20000"};
  const std::string table = run_well(arguments);
  EXPECT_EQ(table.find("ggx:0.3,1,compensated, 20000 samples a view"), 0u);
  Arguments with_json = arguments;
  with_json.push_back("--json");
  const auto json = nlohmann::json::parse(run_well(with_json));
  ASSERT_EQ(json["views"].size(), 7u);
  EXPECT_GT(json["sample_ns"].get<double>(), 0);
  for (const auto& view : json["views"]) {
    EXPECT_NEAR(view["albedo_by_quadrature"][1].get<double>(), 1, 1e-3);  // the table's error
    // Samples: relative std of 0.3, over the root of 20000, five times.
    EXPECT_NEAR(view["albedo_by_sampling"][1].get<double>(), 1, 0.011);
    EXPECT_GT(view["chi_square_p"].get<double>(), 1e-4);
  }
  EXPECT_EQ(run({"brdf", "ward:0.3", "--sampling"}).exit_code, 1);
  EXPECT_EQ(run({"brdf", "ggx:0.3", "--samples", "20000"}).exit_code, 2);
}

TEST_F(BrdfCommandTest, RefusesOtherNamesAndSpecs) {
  for (const Arguments& arguments : {Arguments{"brdf", "ggx:0.5", "-o", "x.hdr"}, Arguments{"brdf", "velvet"},
                                     Arguments{"brdf", "ggx:0.5", "-o", "no/folder/x.binary"}}) {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
  }
  EXPECT_TRUE(files_below(at("")).empty());
}

// A white room's cubes are white, and the energies are what a renderer multiplies by.
TEST_F(BrdfCommandTest, AStackIsWhatItsJsonSays) {
  run_well({"reflect", "sky:constant,value=2,size=16x8", "--brdf", "ggx:0.5", "--method", "single-lobe",
            "--stack", "new/stack"});
  const auto json = nlohmann::json::parse(read_text(at("new/stack/stack.json")));
  ASSERT_EQ(json["cubes"].size(), 1u);
  EXPECT_EQ(json["views"].size(), 16u);
  const std::string file = json["cubes"][0]["file"];
  const LoadedImage image = decode_ktx2(read_file(at("new/stack/" + file)), file);
  ASSERT_TRUE(image.is_cube());
  EXPECT_EQ(image.cube.levels[0].size, json["cubes"][0]["size"]);
  for (float texel : image.cube.levels[0].texels) ASSERT_NEAR(texel, 2, 2e-3);  // half floats
}

TEST_F(BrdfCommandTest, AnisotropicLobesAreForLafortuneAlone) {
  const std::string sky = "sky:studio,size=16x8", lobes = "lafortune:-1:-0.6:0.9:64";
  run_well({"reflect", sky, "--brdf", lobes, "--size", "4", "-o", "s.exr"});
  EXPECT_NE(
      run_well({"reflect", sky, "--brdf", lobes, "--method", "lafortune", "--verify", "--directions", "5"})
          .find("lafortune "),
      std::string::npos);
  const RunResult refused = run({"reflect", sky, "--brdf", lobes, "--method", "lobes", "--verify"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("choose --method lafortune or brute"), std::string::npos);
  const RunResult none = run({"reflect", sky, "--brdf", "ggx:0.5", "--method", "shrm", "--stack", "d"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(at("d")));
}

}  // namespace
}  // namespace welkin
