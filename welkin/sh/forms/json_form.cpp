#include <welkin/sh/forms/json_form.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include <welkin/error.h>
#include <welkin/sh/forms/code_form.h>
#include <welkin/sh/forms/light_lines.h>

namespace welkin {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* generator = "welkin 0.1.0";
constexpr std::array<const char*, 9> babylon_names{"x", "y", "z", "xx", "yy", "zz", "yz", "zx", "xy"};
constexpr int deepest = 8;  // of anything that a coefficient file nests

// Names of files are any bytes, JSON is UTF-8: U+FFFD stands for what is not.
std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

Json lines_of(std::string_view text) {
  Json lines = Json::array();
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines.push_back(std::string(text.substr(0, end)));
    text.remove_prefix(std::min(end, text.size() - 1) + 1);
  }
  return lines;
}

Json convention_of(ShQuantity quantity, const std::string& window) {
  const std::string name(sh_quantity_name(quantity));
  return {{"basis", "real, orthonormal over the sphere"},
          {"condon_shortley_sign", false},
          {"index", "l (l + 1) + m"},
          {"first_functions", "Y_00 = 0.282095, Y_1-1 = 0.488603 y, Y_10 = 0.488603 z, Y_11 = 0.488603 x"},
          {"polar_axis", "z"},
          {"frame",
           "right-handed, +Y up, -Z forward; the middle column of an equirectangular map looks along +X"},
          {"cosine_applied", quantity != ShQuantity::radiance},
          {"one_over_pi_applied", quantity == ShQuantity::irradiance_over_pi},
          {"basis_constants_applied", false},
          {"window", window},
          {"evaluate", name + "(n) = sum over l, m of coefficient[l (l + 1) + m] * Y_lm(n)"}};
}

// As many digits as the coefficients have: the nearest double prints as short.
double digits9(double value) { return std::stod(fmt::format("{:.9g}", value)); }

std::string three_numbers(const double* c) { return fmt::format("{:.9g}, {:.9g}, {:.9g}", c[0], c[1], c[2]); }

// The members of `head`, then the member `name` whose rows have a line each between the two brackets.
std::string with_rows(const Json& head, const char* name, const char* brackets,
                      const std::vector<std::string>& rows) {
  std::string text = dump(head);
  text.resize(text.rfind('\n'));
  text += fmt::format(",\n  \"{}\": {}\n", name, brackets[0]);
  for (std::size_t i = 0; i < rows.size(); ++i)
    text += fmt::format("    {}{}\n", rows[i], i + 1 < rows.size() ? "," : "");
  return text + fmt::format("  {}\n}}\n", brackets[1]);
}

Json lights_of(const ShDocument& document, ShForm form) {
  Json list = Json::array();
  for (const ShLight& ours : document.lights) {
    const ShLight l = turned(ours, form);
    list.push_back(
        {{"direction", {digits9(l.direction.x), digits9(l.direction.y), digits9(l.direction.z)}},
         {"irradiance", {digits9(l.irradiance[0]), digits9(l.irradiance[1]), digits9(l.irradiance[2])}},
         {"angular_radius_degrees", digits9(l.angular_radius * 180 / std::numbers::pi)}});
  }
  return list;
}

// What to do with the lights, for someone who has only the file.
std::vector<const char*> lights_comment(ShForm form) {
  std::vector<const char*> lines{
      "Lights are not in the coefficients, and have the same axes: add, for each, albedo / pi times "
      "irradiance",
      "times max(0, dot(normal, direction))."};
  if (form == ShForm::three)
    lines.insert(lines.end(),
                 {"const sun = new THREE.DirectionalLight(); sun.color.setRGB(...file.lights[0].irradiance); "
                  "sun.position.fromArray(file.lights[0].direction);",
                  "scene.add(sun); (the target stays at the origin; three.js divides by pi itself, r155 and "
                  "later)"});
  return lines;
}

std::string write_json(const ShDocument& document) {
  Json head = {{"generator", generator},
               {"source", document.source},
               {"quantity", std::string(sh_quantity_name(document.quantity))},
               {"max_degree", document.coefficients.max_degree},
               {"convention", convention_of(document.quantity, document.window)},
               {"color", "linear Rec. 709, [red, green, blue]"}};
  if (!document.lights.empty()) head["lights"] = lights_of(document, ShForm::json);
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < document.coefficients.values.size(); i += 3)
    rows.push_back(fmt::format("[{}]", three_numbers(&document.coefficients.values[i])));
  return with_rows(head, "coefficients", "[]", rows);
}

// What a file that is not what it should be is told.
[[noreturn]] void refuse(std::string_view name, const std::string& what) { throw Error(name, what); }

Json parse(std::string_view text, std::string_view name) {
  const auto limit = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) refuse(name, "nests deeper than a coefficient file does");
    return true;
  };
  try {
    return Json::parse(text, limit);
  } catch (const nlohmann::json::out_of_range&) {
    refuse(name, "has a number that is not finite");
  } catch (const nlohmann::json::parse_error& error) {
    if (error.byte > text.size()) refuse(name, "is cut off: its JSON does not end");
    refuse(name, fmt::format("is not whole JSON: it goes wrong at byte {} of {}", error.byte, text.size()));
  }
}

const Json& member(const Json& json, const char* key, std::string_view name) {
  if (!json.is_object() || !json.contains(key)) refuse(name, fmt::format("has no member \"{}\"", key));
  return json[key];
}

double number_of(const Json& json, std::string_view name) {
  if (!json.is_number()) refuse(name, "has a coefficient that is not a number");
  const double value = json.get<double>();
  if (!std::isfinite(value)) refuse(name, "has a coefficient that is not finite");
  return value;
}

// [red, green, blue] to out[0..2].
void read_row(const Json& row, double* out, std::string_view name) {
  if (!row.is_array() || row.size() != 3)
    refuse(name, "has a coefficient that is not [red, green, blue], three numbers");
  for (std::size_t channel = 0; channel < 3; ++channel) out[channel] = number_of(row[channel], name);
}

std::string string_of(const Json& json, const char* key, std::string_view name) {
  if (!json.contains(key)) return "";
  if (!json[key].is_string()) refuse(name, fmt::format("\"{}\" is not a string", key));
  return json[key].get<std::string>();
}

// Coefficients of another convention would be read wrongly and nobody would see it.
void check_convention(const Json& json, ShQuantity quantity, std::string_view name) {
  const Json& convention = member(json, "convention", name);
  const Json expected = convention_of(quantity, "none");
  for (const char* key : {"condon_shortley_sign", "cosine_applied", "one_over_pi_applied",
                          "basis_constants_applied", "index", "polar_axis"}) {
    if (member(convention, key, name) != expected[key])
      refuse(name, fmt::format("has the convention \"{}\": {}, but {} of welkin has {}", key,
                               dump(convention[key]), sh_quantity_name(quantity), dump(expected[key])));
  }
}

std::vector<ShLight> read_lights(const Json& json, ShForm form, std::string_view name) {
  if (!json.contains("lights")) return {};
  const Json& list = json["lights"];
  if (!list.is_array() || list.size() > max_sh_lights)
    refuse(name, fmt::format("\"lights\" is not an array of at most {} lights", max_sh_lights));
  std::vector<ShLight> lights;
  for (const Json& row : list) {
    ShLight light;
    std::array<double, 3> direction{};
    read_row(member(row, "direction", name), direction.data(), name);
    read_row(member(row, "irradiance", name), light.irradiance.data(), name);
    light.direction = {direction[0], direction[1], direction[2]};
    light.angular_radius =
        number_of(member(row, "angular_radius_degrees", name), name) * std::numbers::pi / 180;
    lights.push_back(turned_back(checked(light, name), form));
  }
  return lights;
}

ShDocument read_json(const Json& json, std::string_view name) {
  ShDocument document;
  document.source = string_of(json, "source", name);
  const Json& quantity = member(json, "quantity", name);
  try {
    document.quantity = parse_sh_quantity(quantity.is_string() ? quantity.get<std::string>() : "");
  } catch (const Error& error) {
    refuse(name, error.what());
  }
  check_convention(json, document.quantity, name);
  if (std::string window = string_of(json["convention"], "window", name); !window.empty())
    document.window = std::move(window);
  document.lights = read_lights(json, ShForm::json, name);
  const Json& degree = member(json, "max_degree", name);
  if (!degree.is_number_integer() || degree < 0 || degree > max_projection_degree)
    refuse(name, fmt::format("\"max_degree\" is not a whole number from 0 to {}", max_projection_degree));
  const Json& rows = member(json, "coefficients", name);
  const std::size_t count = sh_count(degree.get<int>());
  if (!rows.is_array() || rows.size() != count)
    refuse(name, fmt::format("has {} coefficients where degree {} has {}", rows.is_array() ? rows.size() : 0,
                             degree.get<int>(), count));
  document.coefficients = ShCoefficients(degree.get<int>(), 3);
  for (std::size_t i = 0; i < count; ++i) read_row(rows[i], &document.coefficients.values[i * 3], name);
  return document;
}

ShFormNumbers read_three(const Json& json, std::string_view name) {
  const Json& sh = member(json, "sh", name);
  if (!sh.is_array() || sh.size() != 27)
    refuse(name, fmt::format("\"sh\" has {} numbers where nine coefficients of red, green, blue have 27",
                             sh.is_array() ? sh.size() : 0));
  ShFormNumbers numbers;
  for (std::size_t i = 0; i < 27; ++i) numbers[i] = number_of(sh[i], name);
  return numbers;
}

ShFormNumbers read_babylon(const Json& json, std::string_view name) {
  const Json& irradiance = member(json, "irradiance", name);
  ShFormNumbers numbers;
  for (std::size_t i = 0; i < 9; ++i)
    read_row(member(irradiance, babylon_names[i], name), &numbers[3 * i], name);
  return numbers;
}

// Which form an object is: it says so, or it has coefficients, or the caller knows.
ShForm form_of(const Json& json, std::string_view name, std::optional<ShForm> bare_form) {
  ShForm form = ShForm::json;
  if (json.contains("form")) {
    const std::string said = string_of(json, "form", name);
    form = said == "three" ? ShForm::three : ShForm::babylon;
    if (said != sh_form_name(form))
      refuse(name, fmt::format("says that its form is '{}', which is none in JSON", said));
  } else if (!json.contains("coefficients")) {
    if (!bare_form) refuse(name, "is JSON, but neither coefficients nor a form that welkin knows");
    return *bare_form;
  }
  if (bare_form && *bare_form != form)
    refuse(name, fmt::format("is {}, not {}", sh_form_name(form), sh_form_name(*bare_form)));
  return form;
}

}  // namespace

std::string write_sh_json(const ShDocument& document, ShForm form, const ShFormNumbers& numbers) {
  if (form == ShForm::json) return write_json(document);
  Json head = {{"generator", generator},
               {"form", std::string(sh_form_name(form))},
               {"source", document.source},
               {"comment", lines_of(about_form(form))}};
  if (!document.lights.empty()) {
    for (const char* line : lights_comment(form)) head["comment"].push_back(line);
    head["lights"] = lights_of(document, form);
  }
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < 9; ++i) {
    const std::string row = three_numbers(&numbers[3 * i]);
    rows.push_back(form == ShForm::three ? row : fmt::format("\"{}\": [{}]", babylon_names[i], row));
  }
  return form == ShForm::three ? with_rows(head, "sh", "[]", rows)
                               : with_rows(head, "irradiance", "{}", rows);
}

ShDocument read_sh_json(std::string_view text, std::string_view name, std::optional<ShForm> bare_form) {
  const Json json = parse(text, name);
  if (!json.is_object()) refuse(name, "is JSON, but not an object");
  const ShForm form = form_of(json, name, bare_form);
  if (form == ShForm::json) return read_json(json, name);
  if (form != ShForm::three && form != ShForm::babylon)
    refuse(name, fmt::format("is a JSON object, which the form {} is not", sh_form_name(form)));
  const ShFormNumbers numbers = form == ShForm::three ? read_three(json, name) : read_babylon(json, name);
  return {from_sh_form(numbers, form), ShQuantity::radiance, string_of(json, "source", name), "none",
          read_lights(json, form, name)};
}

}  // namespace welkin
