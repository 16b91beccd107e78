#include <algorithm>
#include <utility>

#include "command_test.h"

// welkin filter.

namespace welkin {
namespace {

using FilterCommandTest = CommandTest;

TEST_F(FilterCommandTest, WritesACubeAndItsError) {
  const std::string out = run_well({"filter", "sky:studio,size=64x32", "--kernel", "phong:50", "--size", "8",
                                    "-o", "glossy.ktx2", "--verify", "--texels", "400"});
  EXPECT_NE(out.find("phong exponent 50, 8 x 8 x 6"), std::string::npos) << out;
  EXPECT_NE(out.find("frequency"), std::string::npos) << out;
  EXPECT_NE(out.find("at 384 texels anywhere"), std::string::npos) << out;
  const auto info = nlohmann::json::parse(run_well({"info", "glossy.ktx2", "--json"}));
  EXPECT_NE(info.dump().find("KTX2"), std::string::npos) << info;
}

// A constant stays what it is in every kind of file.
TEST_F(FilterCommandTest, EveryMethodAndFile) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"brute", "a.dds"}, {"hierarchical", "a.exr"}, {"angular", "a.hdr"}, {"importance", "a.ktx2"}};
  for (const auto& [method, file] : files) {
    run_well({"filter", "sky:constant,value=2,size=32x16", "--method", method, "--size", "4", "-o", file});
    const auto info = nlohmann::json::parse(run_well({"info", file, "--json"}));
    // Weights add up to one to rounding; .hdr keeps 8 bits.
    EXPECT_NEAR(info["mean_radiance"][1].get<double>(), 2, 0.01) << file;
  }
}

TEST_F(FilterCommandTest, TableOfAllMethods) {
  const std::string out =
      run_well({"filter", "sky:studio,size=64x32", "--method", "all", "--size", "6", "--texels", "8"});
  for (const char* method : {"brute", "hierarchical", "angular", "importance", "frequency"})
    EXPECT_NE(out.find(std::string("\n") + method), std::string::npos) << out;
  EXPECT_TRUE(std::filesystem::is_empty(at("")));
}

TEST_F(FilterCommandTest, PictureBesideTheTruth) {
  run_well(
      {"filter", "sky:studio,size=64x32", "--method", "hierarchical", "--size", "8", "--beside", "a.png"});
  const std::string png = read_text(at("a.png"));
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_GT(png.size(), 1000u);  // three crosses of 256 x 192 pixels
}

TEST_F(FilterCommandTest, RefusesWhatSaysNothingTogether) {
  const std::vector<Arguments> usage{
      {},                                                        // neither -o nor --verify
      {"--method", "all", "-o", "a.ktx2"},                       // compares and writes
      {"--method", "angular", "--samples", "9", "-o", "a.dds"},  // an option of another method
      {"--method", "fast", "-o", "a.dds"},
      {"--size", "0", "-o", "a.dds"},
      {"--beside", "a.jpg"},
      {"--method", "angular", "--cut", "2", "-o", "a.dds"},
      {"--format", "rgb8", "-o", "a.dds"}};
  for (Arguments arguments : usage) {
    arguments.insert(arguments.begin(), {"filter", "sky:constant,size=16x8"});
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments.back();
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
  const std::vector<Arguments> input{{"--kernel", "ggx:4", "-o", "a.dds"},
                                     {"--kernel", "table:missing.txt", "-o", "a.dds"},
                                     {"-o", "a.foo"},
                                     {"-o", "missing/a.dds"}};
  for (Arguments arguments : input) {
    arguments.insert(arguments.begin(), {"filter", "sky:constant,size=16x8"});
    EXPECT_EQ(run(arguments).exit_code, 1) << arguments.back();
  }
  EXPECT_TRUE(std::filesystem::is_empty(at("")));
}

}  // namespace
}  // namespace welkin
