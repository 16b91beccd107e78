#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "forms_sample.h"

#include <welkin/error.h>

// The text of each form: what it says, that it comes back, and that a damaged one is refused in one line.

namespace welkin {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

bool is_code(ShForm form) {
  return form != ShForm::json && form != ShForm::three && form != ShForm::babylon && form != ShForm::filament;
}

// The message of the Error that f throws; "" when it throws none.
std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& text, const std::string& why, std::optional<ShForm> bare_form = {}) {
  const std::string message = refusal([&] { read_sh_text(text, bare_form); });
  EXPECT_NE(message.find(why), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with("file: ")) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

class FormText : public testing::TestWithParam<ShForm> {};
INSTANTIATE_TEST_SUITE_P(Forms, FormText, testing::ValuesIn(all_sh_forms),
                         [](const auto& tested) { return std::string(sh_form_name(tested.param)); });

// Nine digits are written each time: 5e-9 of a number, and up to 8 times that after Babylon's differences.
TEST_P(FormText, RoundTripsThroughEveryOtherForm) {
  for (ShForm other : all_sh_forms)
    for (unsigned seed : {1u, 2u, 3u}) {
      const ShDocument document = random_document(seed);
      const ShDocument first = read_sh_text(write_sh(document, GetParam()));
      const ShDocument second = read_sh_text(write_sh(first, other));
      EXPECT_EQ(second.quantity, ShQuantity::radiance);
      EXPECT_LT(relative_difference(document.coefficients, second.coefficients), 1e-7) << sh_form_name(other);
      EXPECT_EQ(second.source, document.source);
    }
}

TEST_P(FormText, HoldsTheNumbersOfTheEngineOneCoefficientALine) {
  const ShDocument document = random_document(4);
  const bool json = GetParam() == ShForm::json;
  ShFormNumbers numbers;
  if (json)
    std::copy(document.coefficients.values.begin(), document.coefficients.values.end(), numbers.begin());
  if (!json) numbers = to_sh_form(document.coefficients, GetParam());
  const std::string number = R"((-?[0-9.]+(?:e[+-]?[0-9]+)?)f?)";
  const std::regex row(R"re(\s*(?:"[xyz]+": )?(?:vec3|float3|Color)?[\(\[\{]?)re" + number + ", " + number +
                       ", " + number + R"re([\)\]\}]?[,;]?(?:\s*(?://|#).*)?)re");
  std::vector<std::smatch> rows;
  const std::vector<std::string> lines = lines_of(write_sh(document, GetParam()));
  for (const std::string& line : lines) {
    std::smatch match;
    if (std::regex_match(line, match, row)) rows.push_back(match);
  }
  ASSERT_EQ(rows.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = numbers[3 * i + c];
      EXPECT_NEAR(std::stod(rows[i][c + 1]), value, 5e-9 * std::abs(value)) << i;  // nine digits
    }
}

TEST_P(FormText, SaysWhatItHoldsAndIsStable) {
  const std::string text = write_sh(random_document(4), GetParam());
  EXPECT_EQ(text, write_sh(random_document(4), GetParam()));
  EXPECT_NE(text.find("some map.hdr"), std::string::npos);
  const std::vector<const char*> words =
      GetParam() == ShForm::json ? std::vector<const char*>{"\"quantity\"", "\"frame\"", "\"evaluate\""}
                                 : std::vector<const char*>{"Holds: ", "Axes: ", "Use: "};
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << word;
  EXPECT_EQ(text.back(), '\n');
  for (const std::string& line : lines_of(text)) {
    EXPECT_LE(line.size(), 135u) << line;
    EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
  }
}

// Whatever is missing at the end is noticed, unless it is only what comes after the numbers.
TEST_P(FormText, RefusesEveryPrefixOrReadsItRightly) {
  const ShDocument document = random_document(6);
  const std::string text = write_sh(document, GetParam());
  std::size_t refused = 0;
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string prefix = text.substr(0, size);
    try {
      EXPECT_LT(relative_difference(document.coefficients, read_sh_text(prefix).coefficients), 1e-7) << size;
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  // Everything up to the last number.
  const std::size_t last =
      std::max(text.rfind("x x - y y"), text.rfind("L22") == std::string::npos ? 0 : text.rfind("L22"));
  EXPECT_GE(refused, is_code(GetParam()) ? std::min(last, text.find("end coefficients")) : text.size() / 3);
}

TEST_P(FormText, RefusesWhatIsDamaged) {
  const std::string text = write_sh(random_document(7), GetParam());
  const std::size_t begin = is_code(GetParam()) ? text.find("begin coefficients") : 0;
  for (std::size_t i = begin; i < text.size(); i += 7)
    for (const char bad : {'\0', '@', '9', '{', '\n'}) {
      std::string copy = text;
      copy[i] = bad;
      const std::string message = refusal([&] {
        for (double value : read_sh_text(copy).coefficients.values) EXPECT_TRUE(std::isfinite(value));
      });
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
}

TEST_P(FormText, RefusesNumbersThatAreTooManyOrTooFew) {
  const std::string text = write_sh(random_document(8), GetParam());
  const std::vector<std::string> lines = lines_of(text);
  std::vector<std::size_t> rows;
  const std::regex three_numbers(R"(.*-?[0-9.]+(e-?[0-9]+)?f?, -?[0-9.]+(e-?[0-9]+)?f?, -?[0-9.]+.*)");
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (std::regex_match(lines[i], three_numbers)) rows.push_back(i);
  ASSERT_GE(rows.size(), 9u);
  // The line of the second coefficient left out, or there twice.
  const std::size_t changed = rows[GetParam() == ShForm::json ? rows.size() - 8 : 1];
  std::string fewer, more;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i != changed || GetParam() == ShForm::babylon) more += lines[i] + "\n";
    if (i == changed && GetParam() != ShForm::babylon)
      more.append(lines[i]).append("\n").append(lines[i]).append("\n");
    if (i != changed) fewer += lines[i] + "\n";
  }
  if (GetParam() == ShForm::babylon) more = replaced(text, "\"y\": [", "\"y\": [1, ");
  const std::vector<std::pair<ShForm, std::pair<std::string, std::string>>> special = {
      {ShForm::json, {"has 8 coefficients", "has 10 coefficients"}},
      {ShForm::babylon, {"no member", "not [red, green, blue]"}}};
  std::pair<std::string, std::string> why{"24 numbers", "30 numbers"};
  for (const auto& [form, messages] : special)
    if (form == GetParam()) why = messages;
  expect_refused(fewer, why.first);
  expect_refused(more, why.second);
}

TEST(FormTexts, ReadWhatCmgenWrites) {
  std::string text;
  const ShDocument document = random_document(9);
  const ShFormNumbers numbers = to_sh_form(document.coefficients, ShForm::filament);
  const char* names[] = {"L00", "L1-1", "L10", "L11", "L2-2", "L2-1", "L20", "L21", "L22"};
  for (std::size_t i = 0; i < 9; ++i) {
    char line[200];
    std::snprintf(line, sizeof line, "(%18.15f, %18.15f, %18.15f); // %s, irradiance, pre-scaled base\n",
                  numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2], names[i]);
    text += line;
  }
  EXPECT_LT(relative_difference(document.coefficients, read_sh_text(text).coefficients), 1e-13);
  // Without the words of the option --sh-shader it can be anything.
  const std::string other = std::regex_replace(text, std::regex(", irradiance, pre-scaled base"), "");
  expect_refused(other, "--form-in");
  EXPECT_LT(relative_difference(document.coefficients, read_sh_text(other, ShForm::filament).coefficients),
            1e-13);
}

TEST(FormTexts, RefuseOddSignsAndBrackets) {
  std::string list;
  for (int i = 0; i < 26; ++i) list += "1 ";
  expect_refused(list + "+-5", "damaged number", ShForm::unity);
  expect_refused(")(" + list + "1", "bracket", ShForm::unity);
  EXPECT_EQ(refusal([&] { read_sh_text(list + "+5", ShForm::unity); }), "");
}

TEST(FormTexts, ReadBareListsWhenToldTheirForm) {
  std::string plain, array = "[";
  const ShDocument document = random_document(10);
  const ShFormNumbers numbers = to_sh_form(document.coefficients, ShForm::unreal);
  for (std::size_t i = 0; i < 27; ++i) {
    plain += std::to_string(numbers[i]) + (i % 3 == 2 ? "\r\n" : "\t");
    array.append(i > 0 ? "," : "").append(std::to_string(numbers[i]));
  }
  for (const std::string& text : {plain, array + "]", std::string("\xEF\xBB\xBF").append(plain),
                                  std::string("# mine\n").append(plain)}) {
    const ShDocument back = read_sh_text(text, ShForm::unreal);
    EXPECT_LT(relative_difference(document.coefficients, back.coefficients), 1e-6);  // six decimals
    expect_refused(text, "--form-in");
  }
  expect_refused(array, "is cut off", ShForm::unreal);
  expect_refused(plain + "1", "28 numbers", ShForm::unreal);
  expect_refused(plain + "nan", "not finite", ShForm::unreal);
  expect_refused(plain + "1e999", "out of range", ShForm::unreal);
  expect_refused(plain + "1.2.3", "damaged", ShForm::unreal);
  expect_refused(plain, "form-in", ShForm::json);
}

TEST(FormTexts, ReadJsonOfAnEngineWhenToldItsForm) {
  const ShDocument document = random_document(11);
  for (ShForm form : {ShForm::three, ShForm::babylon}) {
    const std::string text = replaced(write_sh(document, form), "\"form\"", "\"what\"");
    EXPECT_LT(relative_difference(document.coefficients, read_sh_text(text, form).coefficients), 1e-7);
    expect_refused(text, "neither coefficients nor a form");
    expect_refused(text, "not", ShForm::godot);
    expect_refused(write_sh(document, form), "not filament", ShForm::filament);
  }
}

TEST(FormTexts, RefuseOtherConventions) {
  const std::string text = write_sh(random_document(12), ShForm::json);
  read_sh_text(text);
  expect_refused(replaced(text, "\"condon_shortley_sign\": false", "\"condon_shortley_sign\": true"),
                 "condon_shortley");
  expect_refused(replaced(text, "\"cosine_applied\": false", "\"cosine_applied\": true"), "cosine_applied");
  expect_refused(replaced(text, "\"polar_axis\": \"z\"", "\"polar_axis\": \"y\""), "polar_axis");
  expect_refused(replaced(text, "\"convention\"", "\"conventions\""), "convention");
  expect_refused(replaced(text, "\"radiance\"", "\"radiosity\""), "unknown quantity");
  expect_refused(replaced(text, "\"max_degree\": 2", "\"max_degree\": 2.5"), "max_degree");
  expect_refused(replaced(text, "\"max_degree\": 2", "\"max_degree\": 1000000000"), "max_degree");
  expect_refused(replaced(text, "\"max_degree\": 2", "\"max_degree\": 3"),
                 "has 9 coefficients where degree 3 has 16");
  expect_refused(replaced(text, "some map.hdr\"", "some map.hdr\", \"form\": \"ogre\""), "ogre");
  expect_refused(replaced(write_sh(random_document(12), ShForm::unity), "unity", "ogre"),
                 "unknown form 'ogre'");
  expect_refused(write_sh(random_document(12), ShForm::unity), "is unity, not godot", ShForm::godot);
}

TEST(FormTexts, RefuseWhatIsNoCoefficientFile) {
  expect_refused("", "empty");
  expect_refused(" \n ", "empty");
  expect_refused("[1, 2]", "--form-in");
  expect_refused("hello", "--form-in");
  expect_refused("{}", "neither coefficients");
  expect_refused("{\"coefficients\": 1}", "no member");
  expect_refused(std::string("{\"a\": ") + std::string(100000, '[') + std::string(100000, ']') + "}",
                 "deeper");
  expect_refused("{\"coefficients\": 1e999}", "not finite");
  expect_refused(std::string(max_sh_file_size + 1, ' '), "bytes");
}

TEST(FormTexts, EveryQuantityBecomesWhatTheEngineReads) {
  const ShDocument radiance = random_document(13);
  const std::string truth = write_sh(radiance, ShForm::three);
  for (ShQuantity quantity : {ShQuantity::irradiance, ShQuantity::irradiance_over_pi}) {
    const ShDocument other{sh_of_quantity(radiance.coefficients, quantity), quantity, radiance.source};
    const ShDocument back = read_sh_text(write_sh(other, ShForm::three));
    EXPECT_LT(relative_difference(radiance.coefficients, back.coefficients), 1e-8);
    const ShDocument json = read_sh_text(write_sh(other, ShForm::json));
    EXPECT_EQ(json.quantity, quantity);
    EXPECT_LT(relative_difference(other.coefficients, json.coefficients), 1e-8);
  }
}

TEST(FormTexts, JsonHoldsAnyDegreeAndOthersRefuse) {
  for (int degree : {0, 1, 3, 16}) {
    const ShDocument document = random_document(14, degree);
    const std::string text = write_sh(document, ShForm::json);
    const ShDocument back = read_sh_text(text);
    EXPECT_EQ(back.coefficients.max_degree, degree);
    EXPECT_LT(relative_difference(document.coefficients, back.coefficients), 1e-8);
    EXPECT_EQ(write_sh(back, ShForm::json), text);  // nine digits stay nine digits
  }
  EXPECT_NE(refusal([] { write_sh(random_document(1, 3), ShForm::unity); }).find("holds degree 2"),
            std::string::npos);
  ShDocument odd{random_document(1, 3).coefficients, ShQuantity::irradiance, ""};
  EXPECT_NE(refusal([&] { sh_radiance_from(odd.coefficients, odd.quantity); }).find("degree 3"),
            std::string::npos);
  odd.coefficients.values[0] = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal([&] { write_sh(odd, ShForm::json); }).find("not finite"), std::string::npos);
}

// A name of a file can be anything; it must not get out of its comment.
TEST(FormTexts, NamesAreNoMarkers) {
  for (const std::string name :
       {"begin coefficients", "end coefficients.hdr", "welkin-light: x.hdr", "welkin-sh: c",
        "welkin-light: direction 0 1 0 irradiance 9 9 9 radius_degrees 0",
        "// welkin-light: direction 0 1 0 irradiance 9 9 9 radius_degrees 0", "pre-scaled base",
        "Source: other", "# end coefficients"}) {
    ShDocument document = random_document(16);
    document.source = name;
    document.window = name;
    for (ShForm form : all_sh_forms) {
      const ShDocument back = read_sh_text(write_sh(document, form));
      EXPECT_LT(relative_difference(document.coefficients, back.coefficients), 1e-7) << name;
      EXPECT_EQ(back.source, name) << sh_form_name(form);
      EXPECT_TRUE(back.lights.empty()) << name;
    }
  }
}

TEST(FormTexts, NamesCannotBreakOut) {
  ShDocument document = random_document(15);
  document.source = "a\nint x;\\\x80\x1b*/";
  for (ShForm form : all_sh_forms) {
    const std::string text = write_sh(document, form);
    EXPECT_EQ(text.find("\nint x"), std::string::npos) << text;
    EXPECT_LT(relative_difference(document.coefficients, read_sh_text(text).coefficients), 1e-7);
  }
}

TEST(FormTexts, AreTold) {
  const auto looks = [](const std::string& text) {
    return looks_like_sh({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  for (ShForm form : all_sh_forms)
    EXPECT_TRUE(looks(write_sh(random_document(1), form))) << sh_form_name(form);
  for (const char* image :
       {"#?RADIANCE\n", "v/1\x01", "\x89PNG", "DDS |", "\xABKTX 20", "\xFF\xD8", "text", ""})
    EXPECT_FALSE(looks(image)) << image;
}

TEST(FormNames, AreReadBack) {
  for (ShForm form : all_sh_forms) EXPECT_EQ(parse_sh_form(sh_form_name(form)), form);
  EXPECT_EQ(refusal([] { parse_sh_form("ogre"); }),
            "unknown form 'ogre'; choose one of json, three, babylon, filament, unity, unreal, godot, c, "
            "glsl, hlsl");
}

}  // namespace
}  // namespace welkin
