#include <string>

#include "command_test.h"

#include "tests/apps/sampling_files.h"
#include "tests/envmap/importance_cases.h"

// welkin sampling: its tables in both containers, what it prints, and what it refuses.

namespace welkin {
namespace {

class SamplingCommandTest : public CommandTest {
 protected:
  SamplingCommandTest() { write_map(at("map.exr"), map_); }

  const Image map_ = sun_map(32, 16, 100);
};

TEST_F(SamplingCommandTest, EveryFormInBothContainersIsTheTable) {
  const EnvironmentSamplerOptions plain, flat{.density = EnvironmentDensity::luminance},
      ntsc{.luminance_weights = {0.2989f, 0.5866f, 0.1145f}};
  const std::vector<std::pair<Arguments, EnvironmentSamplerOptions>> variants = {
      {{}, plain}, {{"--density", "luminance"}, flat}, {{"--weights", "ntsc"}, ntsc}};
  for (const std::string form : {"rows", "cdf", "alias"})
    for (const auto& [more, options] : variants) {
      const Image truth = make_sampling_table(map_, form_from_name(form), options);
      for (const std::string file : {"table.exr", "table.ktx2"}) {
        Arguments arguments{"sampling", "map.exr", "--form", form, "-o", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const std::string out = run_well(arguments);
        const Image table = read_table(at(file));
        ASSERT_EQ(table.width, truth.width) << file;
        ASSERT_EQ(table.height, truth.height) << file;
        EXPECT_EQ(table.channels, truth.channels) << form << file;
        EXPECT_TRUE(table.pixels == truth.pixels) << form << file;
        EXPECT_TRUE(out.starts_with(file + ": ")) << out;
      }
      EXPECT_EQ(read_ktx2_keys(read_file(at("table.ktx2")), "table").at("WelkinQuantity"),
                "sampling table " + form);
    }
}

TEST_F(SamplingCommandTest, PrintsTheRangeOfTheDensityAndTheNoise) {
  write_map(at("even.exr"), constant_map(16, 8, 2));
  const std::string out = run_well({"sampling", "even.exr", "--glsl", "even.glsl"});
  EXPECT_NE(out.find("pdf 0.07958 to 0.07958 per steradian"), std::string::npos) << out;  // 1 / (4 pi)
  // Even light, up: the variance is that of the cosine alone, 4 pi (2 pi / 3) / pi^2 - 1 = 5 / 3.
  EXPECT_NE(out.find("uniform over the sphere                               1.2"), std::string::npos) << out;
  EXPECT_EQ(line_count(out), 5u) << out;
}

TEST_F(SamplingCommandTest, ThePictureMarksTheSun) {
  run_well({"sampling", "map.exr", "--picture", "dots.png", "--points", "50"});
  const Image dots = decode_ldr(read_file(at("dots.png")), "dots.png").flat;
  ASSERT_EQ(dots.width, 32);
  const float* sun = dots.at(32 / 3, 16 / 4);  // a sixth of all light, and 50 samples
  EXPECT_GT(sun[0], 0);
  EXPECT_EQ(sun[1], 0);
  EXPECT_EQ(sun[2], 0);
}

TEST_F(SamplingCommandTest, TheExampleOfTheHelpRuns) {
  const std::string help = run_well({"sampling", "--help"}), start = "Example: welkin ";
  const std::size_t at_example = help.find(start);
  ASSERT_NE(at_example, std::string::npos) << help;
  std::istringstream words(help.substr(at_example + start.size()));
  Arguments arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  ASSERT_EQ(arguments.at(1), "sunset.hdr");
  run_well({"convert", "map.exr", "-o", "sunset.hdr"});
  run_well(arguments);
  for (const char* name : {"sunset_alias.exr", "sunset_alias.glsl", "samples.png"})
    EXPECT_TRUE(std::filesystem::exists(at(name))) << name;
}

TEST_F(SamplingCommandTest, SmallMapsHaveTables) {
  for (int height : {1, 2})
    for (int width : {1, 2}) {
      write_map(at("small.exr"), constant_map(width, height, 3));
      for (const char* form : {"rows", "cdf", "alias"})
        run_well({"sampling", "small.exr", "--mapping", "equirect", "--form", form, "-o", "small.ktx2"});
      EXPECT_EQ(read_table(at("small.ktx2")).at(0, 0)[0], 1);  // each place keeps its texel
    }
}

TEST_F(SamplingCommandTest, BadMapsAreRefused) {
  write_map(at("black.exr"), Image(8, 4));
  expect_refused({"sampling", "black.exr", "-o", "table.exr"}, 1, "black.exr: ");
  expect_refused({"sampling", "missing.hdr", "-o", "table.exr"}, 1, "missing.hdr: ");
  Image broken = map_;
  broken.at(3, 3)[1] = NAN;
  write_map(at("nan.exr"), broken);
  expect_refused({"sampling", "nan.exr", "--faults", "refuse", "-o", "table.exr"}, 1, "nan.exr: ");
}

TEST_F(SamplingCommandTest, OutputsThatCannotBeAreRefused) {
  expect_refused({"sampling", "map.exr", "-o", "map.exr"}, 1, "map.exr: is the input");
  expect_refused({"sampling", "map.exr", "-o", "./map.exr"}, 1, "map.exr: is the input");
  expect_refused({"sampling", "map.exr", "--glsl", "map.exr"}, 1, "map.exr: is the input");
  for (const char* option : {"-o", "--glsl", "--picture"}) {
    const std::string end = option == std::string("--picture") ? "file.png" : "file.exr";
    expect_refused({"sampling", "map.exr", option, "missing/" + end}, 1, "missing/" + end);
    expect_refused({"sampling", "map.exr", option, "map.exr/" + end}, 1, "map.exr/" + end);
  }
  std::filesystem::create_directory(at("folder.exr"));
  expect_refused({"sampling", "map.exr", "-o", "folder.exr"}, 1, "folder.exr: ");
  // All or nothing: the table is not left behind where the shader cannot be written.
  std::filesystem::create_directory(at("folder.glsl"));
  expect_refused({"sampling", "map.exr", "-o", "table.exr", "--glsl", "folder.glsl"}, 1, "folder.glsl: ");
}

TEST_F(SamplingCommandTest, BadUsageIsRefused) {
  expect_refused({"sampling", "map.exr"}, 2, "name a table to write");
  expect_refused({"sampling", "map.exr", "-o", "table.hdr"}, 2, "table.hdr is neither .exr nor .ktx2");
  expect_refused({"sampling", "map.exr", "-o", "table"}, 2, "table is neither");
  expect_refused({"sampling", "map.exr", "--picture", "dots.jpg"}, 2, "dots.jpg is not a .png");
  expect_refused({"sampling", "map.exr", "-o", "table.exr", "--form", "tree"}, 2, "--form");
  expect_refused({"sampling", "map.exr", "-o", "table.exr", "--density", "even"}, 2, "--density");
  expect_refused({"sampling", "map.exr", "-o", "table.exr", "--weights", "srgb"}, 2, "--weights");
  expect_refused({"sampling", "map.exr", "--picture", "dots.png", "--points", "0"}, 2, "--points");
  expect_refused({"sampling", "map.exr", "-o", "one.exr", "--glsl", "one.exr"}, 2, "another output");
}

}  // namespace
}  // namespace welkin
