#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "forms_sample.h"

#include <welkin/error.h>

// Lights beside the coefficients: every form carries them, in its own axes.

namespace welkin {
namespace {

ShDocument with_lights() {
  ShDocument document = random_document(5, 2);
  document.lights = {{normalized(Vec3{0.3, 0.9, -0.4}), {3, 2.5, 1e-3}, 0.0046},
                     {normalized(Vec3{-1, 0.01, 0.2}), {1e5, 0, 7}, 0}};
  return document;
}

class FormLights : public testing::TestWithParam<ShForm> {};
INSTANTIATE_TEST_SUITE_P(Forms, FormLights, testing::ValuesIn(all_sh_forms),
                         [](const auto& tested) { return std::string(sh_form_name(tested.param)); });

TEST_P(FormLights, ComeBack) {
  const ShDocument document = with_lights();
  const ShDocument back = read_sh_text(write_sh(document, GetParam()));
  ASSERT_EQ(back.lights.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const ShLight &a = document.lights[i], &b = back.lights[i];
    EXPECT_LT(length(a.direction - b.direction), 1e-8);  // nine digits
    EXPECT_NEAR(a.angular_radius, b.angular_radius, 1e-8);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a.irradiance[c], b.irradiance[c], 1e-8 * a.irradiance[c]);
  }
}

TEST_P(FormLights, AreInTheAxesOfTheForm) {
  const ShDocument document = with_lights();
  const Vec3 d = GetParam() == ShForm::json ? document.lights[0].direction
                                            : sh_form_axes(GetParam()) * document.lights[0].direction;
  const std::string text = write_sh(document, GetParam());
  const bool code = text.find("welkin-light") != std::string::npos;
  const std::size_t marker = text.find(code ? "light: direction" : "\"direction\"");
  ASSERT_NE(marker, std::string::npos);
  // The three numbers after it, whatever stands between.
  std::size_t at = text.find_first_of("-0123456789", marker);
  for (double expected : {d.x, d.y, d.z}) {
    std::size_t used = 0;
    EXPECT_NEAR(std::stod(text.substr(at), &used), expected, 1e-8);
    at = text.find_first_of("-0123456789", at + used);
  }
}

TEST_P(FormLights, NoneLeaveNoTrace) {
  ShDocument document = with_lights();
  document.lights.clear();
  EXPECT_EQ(write_sh(document, GetParam()).find("welkin-light"), std::string::npos);
  EXPECT_TRUE(read_sh_text(write_sh(document, GetParam())).lights.empty());
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

TEST(FormLightsTexts, DamagedLinesAreRefused) {
  const std::string text = write_sh(with_lights(), ShForm::c);
  for (const auto& [what, with] : {std::pair{"irradiance 3 2.5", "irradiance 3 x"},
                                   {"irradiance 3 2.5", "irradiance 3 -2.5"},
                                   {"irradiance 3 2.5", "irradiance 3"},
                                   {"irradiance 3 2.5", "irradiance nan 2.5"},
                                   {"welkin-light: direction ", "welkin-light: direction 7"},
                                   {"welkin-light: direction", "welkin-light: to"},
                                   {"radius_degrees 0", "radius_degrees 200"},
                                   {"radius_degrees", "radius"}}) {
    try {
      read_sh_text(replaced(text, what, with));
      ADD_FAILURE() << with;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("light"), std::string::npos) << error.what();
    }
  }
}

TEST(FormLightsTexts, AFilamentFileThatIsCutOffLosesNoLight) {
  const ShDocument document = with_lights();
  const std::string text = write_sh(document, ShForm::filament);
  std::size_t ninth = 0;
  for (int line = 0; line < 9; ++line) ninth = text.find('\n', ninth) + 1;
  for (std::size_t end = ninth; end < text.rfind("radius_degrees"); end += 7)
    EXPECT_THROW(read_sh_text(text.substr(0, end)), Error) << end;
}

TEST(FormLightsTexts, LightsThatCannotBeAreNotWritten) {
  ShDocument document = with_lights();
  document.lights[0].direction = {0, 2, 0};
  EXPECT_THROW(write_sh(document, ShForm::json), Error);
  document = with_lights();
  document.lights[1].irradiance[0] = std::nan("");
  EXPECT_THROW(write_sh(document, ShForm::glsl), Error);
}

TEST(FormLightsTexts, JsonKeepsTheWindow) {
  ShDocument document = with_lights();
  document.window = "hann, width 3";
  EXPECT_EQ(read_sh_text(write_sh(document, ShForm::json)).window, "hann, width 3");
  EXPECT_NE(write_sh(document, ShForm::unity).find("Against ringing: hann, width 3"), std::string::npos);
}

}  // namespace
}  // namespace welkin
