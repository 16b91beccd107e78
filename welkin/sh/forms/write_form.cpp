#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include <welkin/error.h>
#include <welkin/sh/forms/code_form.h>
#include <welkin/sh/forms/document.h>
#include <welkin/sh/forms/json_form.h>
#include <welkin/sh/forms/light_lines.h>

namespace welkin {
namespace {

constexpr std::array<const char*, 9> term_names{"1",   "y",         "z",   "x",        "x y",
                                                "y z", "3 z z - 1", "x z", "x x - y y"};
constexpr std::array<const char*, 9> harmonic_names{"L00",  "L1-1", "L10", "L11", "L2-2",
                                                    "L2-1", "L20",  "L21", "L22"};

// A name is any bytes; in a comment of source code only printable ASCII is safe, and no backslash, which would carry
// the comment on to the next line.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~' || c == '\\') c = '?';
  return text;
}

std::string commented(std::string_view lines, std::string_view sign) {
  std::string text;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    text += fmt::format("{} {}\n", sign, lines.substr(0, end));
    lines.remove_prefix(std::min(end, lines.size() - 1) + 1);
  }
  return text;
}

// "1" is an int, and "1f" no number at all in C.
std::string literal(double value, std::string_view suffix) {
  std::string text = fmt::format("{:.9g}", value);
  if (!suffix.empty() && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text.append(suffix);
}

std::string header(ShForm form, const ShDocument& document, std::string_view about, std::string_view sign) {
  std::string text = fmt::format("{} {}{}\n{} Source: {}\n", sign, sh_marker, sh_form_name(form), sign,
                                 printable(document.source));
  if (document.window != "none")
    text += fmt::format("{} Against ringing: {}\n", sign, printable(document.window));
  return text + commented(about, sign) + light_lines(document.lights, form, sign);
}

std::string code_text(const ShDocument& document, ShForm form, const ShFormNumbers& numbers) {
  const CodeForm& code = code_form(form);
  const std::string_view blanks = code.open.substr(0, code.open.find_first_not_of(" \t"));
  std::string text = header(form, document, code.about, code.comment);
  text += fmt::format("\n{}{}{} {}\n", code.before, blanks, code.comment, begin_mark);
  const auto& names = form == ShForm::unreal || form == ShForm::godot ? harmonic_names : term_names;
  for (std::size_t i = 0; i < 9; ++i) {
    const auto number = [&](std::size_t channel) { return literal(numbers[3 * i + channel], code.suffix); };
    text += fmt::format("{}{}, {}, {}{}{}  {} {}\n", code.open, number(0), number(1), number(2), code.close,
                        i < 8 ? "," : "", code.comment, names[i]);
  }
  text += fmt::format("{}{} {}\n{}", blanks, code.comment, end_mark, code.after);
  return form == ShForm::glsl ? text + glsl_matrices(numbers) : text;
}

// The sample programs of Filament read the first nine lines as numbers, so the comment comes last. The ninth line says
// how many lights must follow, lest a file that is cut off loses them.
std::string filament_text(const ShDocument& document, const ShFormNumbers& numbers) {
  std::string text;
  for (std::size_t i = 0; i < 9; ++i)
    text += fmt::format(
        "({:.9g}, {:.9g}, {:.9g}); // {}, irradiance, pre-scaled base{}\n", numbers[3 * i],
        numbers[3 * i + 1], numbers[3 * i + 2], harmonic_names[i],
        i == 8 && !document.lights.empty() ? fmt::format("{}{}", lights_follow, document.lights.size()) : "");
  return text + header(ShForm::filament, document, about_form(ShForm::filament), "//");
}

}  // namespace

std::string write_sh(const ShDocument& document, ShForm form) {
  const ShCoefficients& all = document.coefficients;
  if (all.channels != 3) throw Error("coefficients of one channel have no engine form; three are needed");
  if (!std::all_of(all.values.begin(), all.values.end(), [](double c) { return std::isfinite(c); }))
    throw Error("coefficients that are not finite cannot be written");
  for (const ShLight& light : document.lights) checked(light, document.source);
  if (form == ShForm::json) return write_sh_json(document, form, {});
  if (all.max_degree > 2)
    throw Error(fmt::format("the form {} holds degree 2, and these coefficients have degree {}",
                            sh_form_name(form), all.max_degree));
  const ShFormNumbers numbers = to_sh_form(sh_radiance_from(all, document.quantity), form);
  if (!std::all_of(numbers.begin(), numbers.end(), [](double n) { return std::abs(n) <= FLT_MAX; }))
    throw Error(fmt::format("these coefficients are too large for the floats of the form {}; scale them down",
                            sh_form_name(form)));
  switch (form) {
    case ShForm::three:
    case ShForm::babylon: return write_sh_json(document, form, numbers);
    case ShForm::filament: return filament_text(document, numbers);
    default: return code_text(document, form, numbers);
  }
}

}  // namespace welkin
