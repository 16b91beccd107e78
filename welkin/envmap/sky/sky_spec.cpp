#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>

// The text form of SkyOptions.

namespace welkin {
namespace {

constexpr std::string_view prefix = "sky:";

constexpr std::array<std::pair<std::string_view, SkyKind>, 8> kinds{{{"day", SkyKind::day},
                                                                     {"studio", SkyKind::studio},
                                                                     {"overcast", SkyKind::overcast},
                                                                     {"constant", SkyKind::constant},
                                                                     {"texel", SkyKind::texel},
                                                                     {"ramp", SkyKind::ramp},
                                                                     {"sh", SkyKind::sh},
                                                                     {"labelled", SkyKind::labelled}}};

constexpr std::string_view valid_keys =
    "size, elevation, azimuth, turbidity, albedo, sun, value, x, y, offset, slope, degree, order, scale";

// Splits at `separator`; an empty text gives no parts.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    const std::size_t at = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, at));
    text.remove_prefix(std::min(at + 1, text.size()));
  }
  return parts;
}

template <class Number>
Number parse_number(std::string_view key, std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw Error("sky: " + std::string(key) + "=" + std::string(text) + " is not a " +
                (std::is_integral_v<Number> ? "whole number" : "number"));
  return number;
}

Rgb parse_value(std::string_view text) {
  const std::vector<std::string_view> parts = split(text, ':');
  if (parts.size() == 1) {
    const double grey = parse_number<double>("value", text);
    return {grey, grey, grey};
  }
  if (parts.size() != 3)
    throw Error("sky: value=" + std::string(text) + " is neither one number nor three (1:0.5:0.25)");
  Rgb value;
  for (int c = 0; c < 3; ++c) value[c] = parse_number<double>("value", parts[c]);
  return value;
}

void parse_size(std::string_view text, SkyOptions& options) {
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos)
    throw Error("sky: size=" + std::string(text) + " is not of the form WIDTHxHEIGHT (1024x512)");
  options.width = parse_number<int>("size", text.substr(0, cross));
  options.height = parse_number<int>("size", text.substr(cross + 1));
}

bool parse_switch(std::string_view key, std::string_view text) {
  if (text != "0" && text != "1")
    throw Error("sky: " + std::string(key) + "=" + std::string(text) + " is not 0 or 1");
  return text == "1";
}

void parse_option(std::string_view key, std::string_view text, SkyOptions& options) {
  const std::array<std::pair<std::string_view, double*>, 7> numbers{{{"elevation", &options.elevation},
                                                                     {"azimuth", &options.azimuth},
                                                                     {"turbidity", &options.turbidity},
                                                                     {"albedo", &options.albedo},
                                                                     {"offset", &options.offset},
                                                                     {"slope", &options.slope},
                                                                     {"scale", &options.scale}}};
  const std::array<std::pair<std::string_view, int*>, 4> counts{
      {{"x", &options.x}, {"y", &options.y}, {"degree", &options.degree}, {"order", &options.order}}};
  for (const auto& [name, target] : numbers)
    if (name == key) {
      *target = parse_number<double>(key, text);
      return;
    }
  for (const auto& [name, target] : counts)
    if (name == key) {
      *target = parse_number<int>(key, text);
      return;
    }
  if (key == "size") {
    parse_size(text, options);
  } else if (key == "value") {
    options.value = parse_value(text);
  } else if (key == "sun") {
    options.sun = parse_switch(key, text);
  } else {
    throw Error("sky: unknown key '" + std::string(key) + "'; valid are " + std::string(valid_keys));
  }
}

}  // namespace

SkyKind parse_sky_kind(std::string_view name) {
  std::string names;
  for (const auto& [known, kind] : kinds) {
    if (known == name) return kind;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw Error("sky: unknown kind '" + std::string(name) + "'; valid are " + names);
}

bool is_sky_spec(std::string_view text) { return text.substr(0, prefix.size()) == prefix; }

SkyOptions parse_sky(std::string_view spec) {
  if (is_sky_spec(spec)) spec.remove_prefix(prefix.size());
  SkyOptions options;
  bool first = true;
  for (std::string_view part : split(spec, ',')) {
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos) {
      parse_option(part.substr(0, equals), part.substr(equals + 1), options);
    } else if (first) {
      options.kind = parse_sky_kind(part);
    } else {
      throw Error("sky: '" + std::string(part) + "' is not of the form key=value; valid keys are " +
                  std::string(valid_keys));
    }
    first = false;
  }
  return options;
}

std::string sky_spec_help() {
  return "sky:KIND,key=value,... with KIND one of day, studio, overcast, constant, texel, ramp, sh, "
         "labelled\n"
         "  all:       size=1024x512 scale=1\n"
         "  day:       elevation=35 azimuth=30 turbidity=3 albedo=0.2 sun=1\n"
         "  overcast:  elevation=35 albedo=0.2\n"
         "  constant:  value=1 (or value=R:G:B)\n"
         "  texel:     value=1 x=-1 y=-1 (-1: the middle)\n"
         "  ramp:      value=1 offset=1 slope=0.5\n"
         "  sh:        value=1 degree=2 order=0 offset=1\n";
}

}  // namespace welkin
