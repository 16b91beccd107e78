#include <cmath>
#include <numbers>

#include "command_test.h"

// welkin info, sh, sky and compare, and what all commands have in common.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
using OtherCommandsTest = CommandTest;

TEST_F(OtherCommandsTest, HelpOfEachShowsAnExample) {
  for (const std::string command :
       {"ibl", "filter", "info", "convert", "compare", "reflect", "render", "sh", "sky"}) {
    const std::string help = run_well({command, "--help"});
    EXPECT_NE(help.find("Example"), std::string::npos) << command;
    EXPECT_NE(help.find("welkin " + command + " "), std::string::npos) << command;
    EXPECT_NE(run_well({"--help"}).find("  " + command + " "), std::string::npos) << command;
  }
}

TEST_F(OtherCommandsTest, HelpOfSkyListsKindsAndKeys) {
  const std::string help = run_well({"sky", "--help"});
  EXPECT_NE(help.find("sky:KIND,key=value"), std::string::npos);
  EXPECT_LT(help.find("Example"), help.find("sky:KIND,key=value"));
}

// A name is bytes; what is not UTF-8 in it becomes U+FFFD in JSON, which has to be UTF-8.
TEST_F(OtherCommandsTest, NamesThatAreNotUtf8) {
  const std::string name = "caf\xe9.exr";
  run_well({"sky", "--kind", "constant", "--size", "16x8", "-o", name});
  const std::string shown = "caf\xef\xbf\xbd.exr";
  EXPECT_EQ(nlohmann::json::parse(run_well({"info", name, "--json"}))["source"], shown);
  EXPECT_EQ(nlohmann::json::parse(run_well({"compare", name, name, "--json"}))["a"], shown);
  run_well({"sh", name, "--json", "sh.json"});
  EXPECT_EQ(json("sh.json")["source"], shown);
  EXPECT_EQ(nlohmann::json::parse(run_well({"ibl", name, "-o", "set", "--size", "4", "--json"}))["source"],
            shown);
  EXPECT_EQ(json("set/manifest.json")["source"], shown);
}

// Files that are given away say what they were made of, not where that was on the disk.
TEST_F(OtherCommandsTest, FilesNameTheirSourceWithoutItsFolder) {
  std::filesystem::create_directory(at("private"));
  run_well({"sky", "--kind", "constant", "--size", "16x8", "-o", "private/map.exr"});
  run_well({"ibl", "private/map.exr", "-o", "set", "--size", "4"});
  run_well({"sh", at("private/map.exr").string(), "--json", "sh.json"});
  EXPECT_EQ(json("set/sh.json")["source"], "map.exr");
  EXPECT_EQ(json("sh.json")["source"], "map.exr");
  for (const char* file : {"set/sh.json", "set/manifest.json", "set/index.html", "sh.json"})
    EXPECT_EQ(read_text(at(file)).find("private"), std::string::npos) << file;
}

TEST_F(OtherCommandsTest, Version) { EXPECT_EQ(run_well({"--version"}), "welkin 0.1.0\n"); }

TEST_F(OtherCommandsTest, InfoOfAConstant) {
  const auto info = nlohmann::json::parse(run_well({"info", "sky:constant,value=1,size=64x32", "--json"}));
  // Exact solid angles in double: rounding only.
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(info["irradiance_up"][c], pi, 1e-12);
    EXPECT_NEAR(info["irradiance_down"][c], pi, 1e-12);
    EXPECT_NEAR(info["mean_radiance"][c], 1, 1e-12);
    EXPECT_NEAR(info["energy"][c], 4 * pi, 1e-11);
  }
  EXPECT_EQ(info["width"], 64);
  EXPECT_EQ(info["height"], 32);
  EXPECT_EQ(info["faults"]["nan"], 0);
}

TEST_F(OtherCommandsTest, InfoFindsTheBrightestTexel) {
  const std::string input = "sky:texel,size=64x32,x=40,y=7,value=5";
  const auto info = nlohmann::json::parse(run_well({"info", input, "--json"}));
  EXPECT_EQ(info["brightest_texel"], nlohmann::json({40, 7}));
  EXPECT_NEAR(info["brightest_share"], 1, 1e-12);
  const double theta = pi * 7.5 / 32, phi = 2 * pi * (40.5 / 64 - 0.5);
  const double truth[3] = {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(info["brightest_direction"][c], truth[c], 1e-12);
  EXPECT_NE(run_well({"info", input}).find("(40, 7)"), std::string::npos);
}

// A constant L has the one coefficient L sqrt(4 pi); its irradiance is pi L.
TEST_F(OtherCommandsTest, ShOfAConstant) {
  const std::pair<const char*, double> quantities[] = {
      {"radiance", 1}, {"irradiance", pi}, {"irradiance-over-pi", 1}};
  for (const auto& [quantity, factor] : quantities) {
    run_well({"sh", "sky:constant,value=2,size=32x16", "--degree", "3", "--quantity", quantity, "--json",
              "sh.json"});
    const auto sh = json("sh.json");
    EXPECT_EQ(sh["quantity"], quantity);
    EXPECT_EQ(sh["convention"]["cosine_applied"], std::string(quantity) != "radiance");
    EXPECT_EQ(sh["convention"]["one_over_pi_applied"], std::string(quantity) == "irradiance-over-pi");
    ASSERT_EQ(sh["coefficients"].size(), 16u);
    // Nine digits are written.
    EXPECT_NEAR(sh["coefficients"][0][1], 2 * factor * std::sqrt(4 * pi), 1e-7);
    for (std::size_t i = 1; i < 16; ++i) EXPECT_NEAR(sh["coefficients"][i][1], 0, 1e-7) << i;
  }
}

// A map of Y_21 has the coefficient 1 at l (l + 1) + m = 7 and nowhere else.
TEST_F(OtherCommandsTest, ShNamesItsIndex) {
  run_well({"sh", "sky:sh,degree=2,order=1,offset=2,size=64x32", "--json", "sh.json"});
  const auto rows = json("sh.json")["coefficients"];
  for (std::size_t i = 1; i < 9; ++i) {
    // Texels are means over patches: a function of degree 2 loses (degree pi / height)^2 / 6 = 0.6 %.
    EXPECT_NEAR(rows[i][0], i == 7 ? 1 : 0, 0.01) << i;
  }
  EXPECT_EQ(run_well({"sh", "sky:sh,size=64x32"}).find("radiance of sky:sh"), 0u);
}

TEST_F(OtherCommandsTest, SkyWritesWhatItsSpecSays) {
  for (const std::string kind :
       {"day", "studio", "overcast", "constant", "texel", "ramp", "sh", "labelled"}) {
    run_well({"sky", "--kind", kind, "--size", "32x16", "-o", kind + ".exr"});
    const auto file = nlohmann::json::parse(run_well({"info", kind + ".exr", "--json"}));
    const auto spec = nlohmann::json::parse(run_well({"info", "sky:" + kind + ",size=32x16", "--json"}));
    for (const char* member : {"mean_radiance", "irradiance_up"}) {
      const double truth = spec[member][1];
      EXPECT_NEAR(file[member][1], truth, truth * std::exp2(-11)) << kind;  // half floats
    }
    EXPECT_EQ(file["brightest_texel"], spec["brightest_texel"]) << kind;
  }
}

TEST_F(OtherCommandsTest, SkyOptionsAreItsKeys) {
  run_well(
      {"sky", "--elevation", "12", "--azimuth", "-40", "--turbidity", "5", "--size", "64x32", "-o", "a.exr"});
  const auto file = nlohmann::json::parse(run_well({"info", "a.exr", "--json"}));
  const auto sun = file["brightest_direction"];
  // The sun lies in one texel of 5.6 degrees: its centre is within half a diagonal.
  EXPECT_NEAR(std::asin(sun[1].get<double>()) * 180 / pi, 12, 4);
  EXPECT_NEAR(std::atan2(sun[2].get<double>(), sun[0].get<double>()) * 180 / pi, -40, 4);
  run_well({"sky", "--elevation", "12", "--no-sun", "--size", "64x32", "-o", "b.exr"});
  const auto without = nlohmann::json::parse(run_well({"info", "b.exr", "--json"}));
  // What is left is the sky beside the sun, 1 % of a texel that holds the disc.
  EXPECT_LT(without["max_radiance"].get<double>(), 0.05 * file["max_radiance"].get<double>());
}

// A half float ends at 65,504; this sun is brighter, and nothing may be lost.
TEST_F(OtherCommandsTest, SkyKeepsABrightSunInOpenExr) {
  run_well({"sky", "--kind", "texel", "--value", "200000", "--size", "32x16", "-o", "sun.exr"});
  EXPECT_EQ(nlohmann::json::parse(run_well({"info", "sun.exr", "--json"}))["max_radiance"], 200000);
}

TEST_F(OtherCommandsTest, SkySaysWhatHdrCannotHold) {
  const RunResult result =
      run({"sky", "--kind", "ramp", "--offset", "0", "--slope", "1", "--size", "8x4", "-o", "r.hdr"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "welkin: r.hdr: warning: 48 negative values became 0, which is the least that .hdr can hold\n");
}

TEST_F(OtherCommandsTest, CompareWithItselfIsZero) {
  run_well({"sky", "--kind", "studio", "--size", "32x16", "-o", "a.exr"});
  run_well({"convert", "a.exr", "--to", "cube", "--mips", "--size", "8", "-o", "a.ktx2"});
  for (const std::string file : {"a.exr", "a.ktx2"}) {
    const auto result = nlohmann::json::parse(run_well({"compare", file, file, "--json"}));
    EXPECT_EQ(result["parts"].size(), file == "a.exr" ? 1u : 4u * 7);  // four levels, each whole and by face
    for (const auto& part : result["parts"]) {
      EXPECT_EQ(part["rmse"], 0);
      EXPECT_EQ(part["max_abs"], 0);
      EXPECT_TRUE(part["psnr_db"].is_null());
    }
  }
}

TEST_F(OtherCommandsTest, CompareMeasuresAKnownDifference) {
  run_well({"sky", "--kind", "constant", "--value", "1.5", "--size", "8x4", "-o", "a.exr"});
  run_well({"sky", "--kind", "constant", "--value", "2", "--size", "8x4", "-o", "b.exr"});
  for (const bool weighted : {false, true}) {
    Arguments arguments{"compare", "a.exr", "b.exr", "--json", "--diff", "d.png"};
    if (weighted) arguments.push_back("--solid-angle");
    const auto part = nlohmann::json::parse(run_well(arguments))["parts"][0];
    EXPECT_NEAR(part["rmse"], 0.5, 1e-6);
    EXPECT_NEAR(part["relative_rmse"], 0.25, 1e-6);
    EXPECT_NEAR(part["max_abs"], 0.5, 1e-6);
  }
  EXPECT_EQ(read_text(at("d.png")).substr(1, 3), "PNG");
}

using SkyInputTest = CommandTest;

TEST_F(SkyInputTest, ConvertAndCompareTakeASkyForAFile) {
  const std::string sky = "sky:day,size=32x16";
  run_well({"sky", "--kind", "day", "--size", "32x16", "-o", "made.exr"});
  run_well({"convert", sky, "-o", "converted.exr"});
  EXPECT_EQ(read_text(at("made.exr")), read_text(at("converted.exr")));
  const auto same = nlohmann::json::parse(run_well({"compare", sky, sky, "--json"}));
  EXPECT_EQ(same.dump().find("null") == std::string::npos, false);  // an infinite PSNR
  const RunResult bad = run({"compare", "sky:moon", "made.exr"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.err.find("moon"), std::string::npos) << bad.err;
}

TEST_F(SkyInputTest, ADifferenceIsAPngAndOverwritesNoInput) {
  run_well({"convert", "sky:day,size=32x16", "-o", "a.png"});
  const std::string before = read_text(at("a.png"));
  EXPECT_EQ(run({"compare", "a.png", "sky:day,size=32x16", "--diff", "d.jpg"}).exit_code, 2);
  EXPECT_EQ(run({"compare", "a.png", "sky:day,size=32x16", "--diff", "./a.png"}).exit_code, 1);
  EXPECT_EQ(read_text(at("a.png")), before);
  EXPECT_FALSE(std::filesystem::exists(at("d.jpg")));
}

TEST_F(SkyInputTest, ZstandardIsForKtx2) {
  const RunResult result =
      run({"ibl", "sky:day,size=32x16", "-o", "set", "--size", "4", "--container", "dds", "--zstd", "3"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--zstd"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace welkin
