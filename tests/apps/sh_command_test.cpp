#include <string>

#include "command_test.h"

#include <welkin/sh/forms/document.h>

// welkin sh --form: from environments and from coefficient files, into the forms of engines.

namespace welkin {
namespace {

const std::string map = "sky:labelled,size=32x16";

using ShCommandTest = CommandTest;

TEST_F(ShCommandTest, EveryFormOfAnEnvironmentComesBackAsItsCoefficients) {
  run_well({"sh", map, "--json", "truth.json"});
  const auto truth = json("truth.json");
  for (ShForm form : all_sh_forms) {
    const std::string name(sh_form_name(form));
    run_well({"sh", map, "--form", name, "-o", name});
    EXPECT_EQ(run_well({"sh", map, "--form", name}), read_text(at(name)));
    run_well({"sh", name, "--json", "back.json"});
    const auto back = json("back.json");
    EXPECT_EQ(back["source"], map) << name;
    EXPECT_EQ(back["quantity"], "radiance") << name;
    for (std::size_t i = 0; i < 9; ++i)
      for (std::size_t c = 0; c < 3; ++c)  // nine digits, twice
        EXPECT_NEAR(back["coefficients"][i][c], truth["coefficients"][i][c], 2e-7) << name << i;
  }
}

TEST_F(ShCommandTest, ReadsTheFileOfASet) {
  run_well({"ibl", map, "-o", "set", "--size", "4"});
  run_well({"sh", map, "--form", "unity", "-o", "direct.cs"});
  const std::string from_set = run_well({"sh", "set/sh.json", "--form", "unity"});
  EXPECT_NE(from_set.find("sh[channel, i] = coefficients[i, channel]"), std::string::npos);
  EXPECT_EQ(line_count(from_set), line_count(read_text(at("direct.cs"))));
  EXPECT_EQ(run_well({"sh", "set/sh.json"}).find("radiance of " + map), 0u);
}

TEST_F(ShCommandTest, QuantityAndDegreeOfAFile) {
  run_well({"sh", map, "--degree", "4", "--json", "four.json"});
  run_well({"sh", map, "--quantity", "irradiance", "--json", "truth.json"});
  run_well({"sh", "four.json", "--degree", "2", "--quantity", "irradiance", "--json", "two.json"});
  EXPECT_EQ(json("two.json")["max_degree"], 2);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(json("two.json")["coefficients"][i][1], json("truth.json")["coefficients"][i][1], 1e-7) << i;
  EXPECT_EQ(run_well({"sh", "two.json", "--form", "json"}), read_text(at("two.json")));
  expect_refused({"sh", "four.json", "--form", "godot"}, 1,
                 "four.json: has degree 4, and --form godot holds degree 2");
  expect_refused({"sh", "two.json", "--degree", "4"}, 1, "two.json: has degree 2, less than --degree 4");
  run_well({"sh", "four.json", "--quantity", "irradiance", "--json", "four_irradiance.json"});
  expect_refused({"sh", "four_irradiance.json", "--quantity", "radiance"}, 1,
                 "four_irradiance.json: radiance does not follow");
  run_well({"sh", "four_irradiance.json", "--degree", "2", "--form", "godot"});
}

TEST_F(ShCommandTest, FormsFixTheirQuantityAndDegree) {
  expect_refused({"sh", map, "--form", "three", "--quantity", "irradiance"}, 2, "fixed by --form three");
  expect_refused({"sh", map, "--form", "three", "--degree", "3"}, 2, "is 2 in --form three");
  expect_refused({"sh", map, "--form", "ogre"}, 2, "--form");
  expect_refused({"sh", map, "-o", "file"}, 2, "needs --form");
  expect_refused({"sh", map, "--form", "three", "--json", "file"}, 2, "--json");
  run_well(
      {"sh", map, "--form", "json", "--degree", "3", "--quantity", "irradiance-over-pi", "-o", "sh.json"});
  EXPECT_EQ(json("sh.json")["coefficients"].size(), 16u);
}

TEST_F(ShCommandTest, BareListsNeedTheirForm) {
  std::string list;
  for (int i = 0; i < 27; ++i) list += i < 3 ? "3.54490770181\n" : "0.00000000000\n";  // sqrt(4 pi)
  write_text(at("list.txt"), list);
  EXPECT_NE(run_well({"sh", "list.txt", "--form-in", "three", "--form", "filament"}).find("(1, 1, 1)"),
            std::string::npos);
  write_text(at("short.txt"), list.substr(0, list.size() - 14));
  expect_refused({"sh", "short.txt", "--form-in", "three"}, 1, "short.txt: has 26 numbers");
  expect_refused({"sh", "list.txt"}, 1, "list.txt: ");
  expect_refused({"sh", "missing.txt", "--form-in", "three"}, 1, "missing.txt: ");
}

TEST_F(ShCommandTest, DamagedFilesGetOneLineThatNamesThem) {
  for (const std::string form : {"json", "three", "unity", "filament"}) {
    const std::string text = run_well({"sh", map, "--form", form});
    write_text(at("cut"), text.substr(0, form == "filament" ? 300 : text.size() - text.size() / 4));
    expect_refused({"sh", "cut", "--form", "c", "-o", "out.h"}, 1, "cut: ");
  }
  write_text(at("list.json"), "[1, 2, 3]");
  expect_refused({"sh", "list.json"}, 1, "list.json: does not say what its numbers are");
  run_well({"sh", map, "--form", "hlsl", "-o", "a.hlsl"});
  expect_refused({"sh", "a.hlsl", "--mapping", "cube"}, 2, "file of coefficients");
}

}  // namespace
}  // namespace welkin
