#include <sys/stat.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include "command_test.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/light_fit.h>
#include <welkin/sh/forms/document.h>
#include <welkin/sh/minimum.h>
#include <welkin/sh/nonnegative.h>
#include <welkin/sh/rotation.h>

// welkin sh: fits, lights and turns.

namespace welkin {
namespace {

// One texel: irradiance from nine coefficients is negative behind it.
const std::string lamp = "sky:texel,size=64x32";

class ShFitCommandTest : public CommandTest {
 protected:
  ShDocument document(const std::string& name) const { return read_sh_file(at(name)); }

  void expect_refused(const Arguments& arguments, int exit_code, const std::string& why) const {
    const RunResult result = run(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << testing::PrintToString(arguments);
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
    EXPECT_TRUE(files_below(at("")).empty());
  }
};

std::array<double, 9> channel(const ShCoefficients& c, std::size_t k) {
  std::array<double, 9> out{};
  for (std::size_t i = 0; i < 9; ++i) out[i] = c.values[3 * i + k];
  return out;
}

TEST_F(ShFitCommandTest, TheNonnegativeFitCarriesItsProof) {
  run_well({"sh", lamp, "--quantity", "irradiance", "--json", "plain.json"});
  run_well({"sh", lamp, "--quantity", "irradiance", "--fit", "nonnegative", "--json", "fit.json"});
  const ShDocument plain = document("plain.json"), fit = document("fit.json");
  std::istringstream words(fit.window.substr(fit.window.find("multipliers") + 11));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(minimum_degree2(channel(plain.coefficients, c)), -1e-3 * plain.coefficients.values[c]);
    EXPECT_GE(minimum_degree2(channel(fit.coefficients, c)), 0);
    double multiplier = 0;
    ASSERT_TRUE(words >> multiplier) << fit.window;
    EXPECT_TRUE(proves_nonnegative(channel(fit.coefficients, c), multiplier));
  }
}

TEST_F(ShFitCommandTest, EveryFitChangesTheCoefficientsAndSaysSo) {
  run_well({"sh", lamp, "--json", "plain.json"});
  const ShDocument plain = document("plain.json");
  for (const std::string name : {"nonnegative", "zh3-nonnegative", "hann", "lanczos", "laplacian"}) {
    run_well({"sh", lamp, "--fit", name, "--json", name + ".json"});
    const ShDocument fit = document(name + ".json");
    EXPECT_NE(fit.window, "none") << name;
    EXPECT_EQ(fit.quantity, ShQuantity::radiance);
    EXPECT_GT(std::abs(fit.coefficients.values[6 * 3] - plain.coefficients.values[6 * 3]),
              1e-3 * plain.coefficients.values[0])
        << name;
    const ShCoefficients irradiance = sh_of_quantity(fit.coefficients, ShQuantity::irradiance);
    // hann and lanczos of width 3 leave something negative; the rest nine digits' rounding.
    const double least = name == "hann" || name == "lanczos" ? -0.2 : -1e-8;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_GE(minimum_degree2(channel(irradiance, c)), least * irradiance.values[c]) << name;
  }
  // One lamp is zonal: ZH3 loses nothing.
  run_well({"sh", lamp, "--fit", "zh3", "--json", "zh3.json"});
  const ShDocument zh3 = document("zh3.json");
  for (std::size_t i = 0; i < 27; ++i)
    EXPECT_NEAR(zh3.coefficients.values[i], plain.coefficients.values[i],
                1e-4 * plain.coefficients.values[0]);
}

TEST_F(ShFitCommandTest, AFileTurnsAsItsEnvironmentDoes) {
  const std::string map = "sky:day,size=64x32";
  const Arguments turns[] = {{"--rotate", "45"}, {"--mirror"}, {"--rotate", "-90", "--mirror"}};
  run_well({"sh", map, "--extract-sun", "--degree", "3", "--json", "plain.json"});
  for (const Arguments& turned : turns) {
    Arguments direct{"sh", map, "--extract-sun", "--degree", "3", "--json", "direct.json"};
    Arguments later{"sh", "plain.json", "--json", "later.json"};
    direct.insert(direct.end(), turned.begin(), turned.end());
    later.insert(later.end(), turned.begin(), turned.end());
    run_well(direct);
    run_well(later);
    const ShDocument a = document("direct.json"), b = document("later.json");
    for (std::size_t i = 0; i < a.coefficients.values.size(); ++i)  // texels only move; nine digits
      EXPECT_NEAR(a.coefficients.values[i], b.coefficients.values[i], 1e-6 * a.coefficients.values[0]) << i;
    ASSERT_EQ(a.lights.size(), 1u);
    ASSERT_EQ(b.lights.size(), 1u);
    EXPECT_LT(length(a.lights[0].direction - b.lights[0].direction), 1e-6);
  }
}

TEST_F(ShFitCommandTest, FittedLightsAreThoseOfTheLibrary) {
  const std::string map = "sky:day,size=128x64";
  run_well({"sh", map, "--fit-lights", "2", "--form", "unity", "-o", "probe.cs"});
  const ShDocument written = document("probe.cs");
  const LightFit fit = fit_lights(load_environment(map).radiance, 2);
  ASSERT_EQ(written.lights.size(), fit.lights.size());
  for (std::size_t i = 0; i < fit.lights.size(); ++i)
    EXPECT_LT(length(written.lights[i].direction - fit.lights[i].direction), 1e-8);
  for (std::size_t i = 0; i < 27; ++i)
    EXPECT_NEAR(written.coefficients.values[i], fit.rest.values[i], 1e-7 * std::abs(fit.rest.values[0]));
}

TEST_F(ShFitCommandTest, WithoutASunThereIsAWarning) {
  const RunResult result = run({"sh", "sky:overcast,size=64x32", "--extract-sun"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("no light"), std::string::npos);
}

TEST_F(ShFitCommandTest, MisuseIsRefused) {
  expect_refused({"sh", lamp, "--fit", "best"}, 2, "--fit");
  expect_refused({"sh", lamp, "--window-width", "2"}, 2, "--window-width");
  expect_refused({"sh", lamp, "--fit", "hann", "--window-width", "nan"}, 2, "--window-width");
  expect_refused({"sh", lamp, "--fit", "nonnegative", "--degree", "4"}, 2, "degree 2");
  expect_refused({"sh", lamp, "--fit-lights", "2", "--degree", "4"}, 2, "--fit-lights");
  expect_refused({"sh", lamp, "--fit-lights", "2", "--extract-sun"}, 2, "--fit-lights");
  expect_refused({"sh", lamp, "--residual", "a.exr"}, 2, "--residual");
  expect_refused({"sh", lamp, "--json", ""}, 2, "--json");
  expect_refused({"sh", lamp, "--form", "c", "-o", ""}, 2, "-o");
}

TEST_F(ShFitCommandTest, NoOutputOverwritesTheInput) {
  run_well({"convert", "sky:day,size=64x32", "-o", "map.hdr"});
  run_well({"sh", "map.hdr", "--json", "a.json"});
  std::filesystem::create_hard_link(at("a.json"), at("same.json"));
  const auto before = files_below(at(""));
  for (const Arguments& wrong : {Arguments{"sh", "map.hdr", "--json", "./map.hdr"},
                                 {"sh", "map.hdr", "--form", "c", "-o", "map.hdr"},
                                 {"sh", "a.json", "--fit", "nonnegative", "--json", "a.json"},
                                 {"sh", "a.json", "--form", "three", "-o", "same.json"}}) {
    const RunResult result = run(wrong);
    EXPECT_EQ(result.exit_code, 1) << testing::PrintToString(wrong);
    EXPECT_NE(result.err.find("is the input"), std::string::npos) << result.err;
    EXPECT_TRUE(files_below(at("")) == before) << testing::PrintToString(wrong);
  }
}

TEST_F(ShFitCommandTest, NoFileIsLeftWhenAnotherCannotBeWritten) {
  const std::string sun = "sky:day,size=128x64";
  for (const Arguments& output :
       {Arguments{"--json", "missing/a.json"}, {"--json", "/dev/full"}, {"--form", "c", "-o", "/dev/full"}}) {
    Arguments all{"sh", sun, "--extract-sun", "--residual", "rest.exr"};
    all.insert(all.end(), output.begin(), output.end());
    expect_refused(all, 1, output.back());
  }
  expect_refused({"sh", sun, "--extract-sun", "--residual", "missing/rest.exr", "--json", "a.json"}, 1,
                 "missing/rest.exr");
  expect_refused({"ibl", sun, "--extract-sun", "--residual", "missing/rest.exr", "-o", "set"}, 1,
                 "missing/rest.exr");
  run_well({"ibl", sun, "--extract-sun", "--size", "8", "--residual", "set/rest.exr", "-o", "./set/"});
}

TEST_F(ShFitCommandTest, CoefficientsComeOutOfAPipe) {
  run_well({"sh", lamp, "--json", "a.json"});
  const std::string text = read_text(at("a.json"));
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(at("pipe"), std::ios::binary) << text; });
  const std::string table = run_well({"sh", "pipe", "--form-in", "json"});
  writer.join();
  EXPECT_EQ(table, run_well({"sh", "a.json"}));
}

TEST_F(ShFitCommandTest, TheResidualOverwritesNothing) {
  run_well({"convert", "sky:day,size=64x32", "-o", "map.hdr"});
  const auto before = files_below(at(""));
  for (const Arguments& wrong :
       {Arguments{"sh", "map.hdr", "--extract-sun", "--residual", "./map.hdr"},
        {"sh", "map.hdr", "--extract-sun", "--residual", "r.hdr", "--form", "json", "-o", "./r.hdr"},
        {"sh", "map.hdr", "--extract-sun", "--residual", "r.hdr", "--json", "r.hdr"},
        {"ibl", "map.hdr", "--extract-sun", "--size", "4", "-o", "set", "--residual", "set/preview.png"},
        {"ibl", "map.hdr", "--extract-sun", "--size", "4", "-o", "set", "--residual", "map.hdr"}}) {
    const RunResult result = run(wrong);
    EXPECT_EQ(result.exit_code, 1) << testing::PrintToString(wrong);
    EXPECT_EQ(line_count(result.err), 1u) << result.err;
    EXPECT_TRUE(files_below(at("")) == before) << testing::PrintToString(wrong);
  }
}

TEST_F(ShFitCommandTest, TheTableSendsNoControlCharactersToATerminal) {
  run_well({"sh", lamp, "--json", "a.json"});
  std::string text = read_text(at("a.json"));
  const std::size_t at_source = text.find("\"source\": \"");
  ASSERT_NE(at_source, std::string::npos);
  text.insert(at_source + 11, "\\u001b[31m\\u0007");
  write_text(at("b.json"), text);
  const std::string out = run_well({"sh", "b.json"});
  EXPECT_EQ(out.find('\x1b'), std::string::npos);
  EXPECT_EQ(out.find('\x07'), std::string::npos);
  EXPECT_NE(out.find("?[31m?"), std::string::npos) << out.substr(0, 120);
}

TEST_F(ShFitCommandTest, CoefficientsHaveNoLightsToTakeOut) {
  run_well({"sh", lamp, "--json", "a.json"});
  for (const Arguments& wrong :
       {Arguments{"--extract-sun"}, {"--fit-lights", "1"}, {"--mapping", "cube"}, {"--faults", "refuse"}}) {
    Arguments all{"sh", "a.json"};
    all.insert(all.end(), wrong.begin(), wrong.end());
    const RunResult result = run(all);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("file of coefficients"), std::string::npos) << result.err;
  }
}

TEST_F(ShFitCommandTest, WhatLeavesTheRangeOfNumbersIsRefused) {
  run_well({"sh", lamp, "--json", "a.json"});
  ShDocument huge = document("a.json");
  const auto refused = [&](double scale, const Arguments& options, const std::string& why) {
    for (std::size_t i = 0; i < huge.coefficients.values.size(); ++i)
      huge.coefficients.values[i] = i % 2 ? scale : -scale;
    write_text(at("a.json"), write_sh(huge, ShForm::json));
    Arguments all{"sh", "a.json"};
    all.insert(all.end(), options.begin(), options.end());
    const RunResult result = run(all);
    EXPECT_EQ(result.exit_code, 1) << testing::PrintToString(all);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err.find("welkin: a.json: "), 0u) << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
  };
  for (ShForm form : all_sh_forms)
    if (form != ShForm::json) refused(1e41, {"--form", std::string(sh_form_name(form))}, "too large");
  refused(1.7e308, {"--quantity", "irradiance"}, "too large");
  refused(1.7e308, {"--rotate", "30"}, "too large");
}

TEST_F(ShFitCommandTest, TextWithoutItsFormIsTold) {
  write_text(at("a.txt"), "1 2 3");
  EXPECT_NE(run({"sh", "a.txt"}).err.find("--form-in"), std::string::npos);
  write_text(at("a.json"), "{\"coefficients\": [[1, 2");
  EXPECT_NE(run({"sh", "a.json"}).err.find("cut off"), std::string::npos);
}

}  // namespace
}  // namespace welkin
