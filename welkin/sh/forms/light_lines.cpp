#include <welkin/sh/forms/light_lines.h>

#include <fmt/format.h>

#include <cstdint>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>

#include <welkin/error.h>
#include <welkin/sh/forms/code_form.h>

namespace welkin {
namespace {

constexpr double degree = std::numbers::pi / 180;

// Reads "direction x y z irradiance r g b radius_degrees a".
class LineReader {
 public:
  LineReader(std::string_view text, std::string_view name) : rest_(text), name_(name) {}

  void word(std::string_view expected) {
    skip();
    if (!rest_.starts_with(expected)) refuse();
    rest_.remove_prefix(expected.size());
  }

  double number() {
    skip();
    double value = 0;
    const auto [next, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) refuse();
    rest_.remove_prefix(static_cast<std::size_t>(next - rest_.data()));
    return value;
  }

  void end() {
    skip();
    if (!rest_.empty()) refuse();
  }

 private:
  void skip() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\r')) rest_.remove_prefix(1);
  }
  [[noreturn]] void refuse() const { throw Error(name_, "has a damaged line of a light"); }

  std::string_view rest_, name_;
};

// What the ninth line of a filament file says; names of files come after it.
std::optional<std::size_t> promised_lights(std::string_view text) {
  const std::size_t at = text.find(lights_follow);
  if (at == std::string_view::npos) return {};
  const std::string_view rest = text.substr(at + lights_follow.size());
  std::size_t count = 0;
  const auto [next, error] = std::from_chars(rest.data(), rest.data() + rest.size(), count);
  return error == std::errc() ? std::optional(count) : std::nullopt;
}

ShLight read_line(std::string_view text, std::string_view name) {
  LineReader line(text, name);
  ShLight light;
  line.word("direction");
  for (double* v : {&light.direction.x, &light.direction.y, &light.direction.z}) *v = line.number();
  line.word("irradiance");
  for (double& v : light.irradiance) v = line.number();
  line.word("radius_degrees");
  light.angular_radius = line.number() * degree;
  line.end();
  return light;
}

}  // namespace

ShLight turned(const ShLight& light, ShForm form) {
  ShLight out = light;
  if (form != ShForm::json) out.direction = sh_form_axes(form) * light.direction;
  return out;
}

ShLight turned_back(const ShLight& light, ShForm form) {
  ShLight out = light;
  if (form != ShForm::json) out.direction = transposed(sh_form_axes(form)) * light.direction;
  return out;
}

ShLight checked(ShLight light, std::string_view name) {
  const double size = length(light.direction);
  if (!(std::abs(size - 1) <= 1e-3)) throw Error(name, "has a light whose direction is not of unit length");
  light.direction = (1 / size) * light.direction;
  for (double e : light.irradiance)
    if (!(std::isfinite(e) && e >= 0))
      throw Error(name, "has a light whose irradiance is not finite and >= 0");
  if (!(light.angular_radius >= 0 && light.angular_radius <= std::numbers::pi / 2))
    throw Error(name, "has a light whose angular radius is not 0 to 90 degrees");
  return light;
}

std::string light_lines(const std::vector<ShLight>& lights, ShForm form, std::string_view sign) {
  if (lights.empty()) return "";
  std::string text = fmt::format(
      "{} Lights that are not in the coefficients, in the same axes: add, for each, albedo / pi times "
      "irradiance\n"
      "{} times max(0, dot(normal, direction)).\n",
      sign, sign);
  if (form == ShForm::unity)
    text += fmt::format(
        "{} Unity's own lights lack the 1 / pi (built-in and universal pipeline): linear color times "
        "intensity =\n"
        "{} irradiance / pi, transform.forward = -direction.\n",
        sign, sign);
  for (const ShLight& ours : lights) {
    const ShLight l = turned(ours, form);
    text += fmt::format(
        "{} {}direction {:.9g} {:.9g} {:.9g} irradiance {:.9g} {:.9g} {:.9g} radius_degrees {:.9g}\n", sign,
        light_marker, l.direction.x, l.direction.y, l.direction.z, l.irradiance[0], l.irradiance[1],
        l.irradiance[2], l.angular_radius / degree);
  }
  return text;
}

std::vector<ShLight> lights_in(std::string_view text, ShForm form, std::string_view name) {
  std::vector<ShLight> lights;
  constexpr std::size_t any = SIZE_MAX;
  const std::size_t promised = form == ShForm::filament ? promised_lights(text).value_or(any) : any;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::optional<std::string_view> comment = comment_of(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!comment || !comment->starts_with(light_marker)) continue;
    lights.push_back(turned_back(checked(read_line(comment->substr(light_marker.size()), name), name), form));
    if (lights.size() > max_sh_lights)
      throw Error(name, fmt::format("has more than {} lights", max_sh_lights));
  }
  if (promised != any && promised != lights.size())
    throw Error(name, fmt::format("is cut off: it has {} of its {} lights", lights.size(), promised));
  return lights;
}

}  // namespace welkin
