#include <welkin/brdf/lafortune.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/brdf/spec_numbers.h>
#include <welkin/error.h>

namespace welkin {
namespace {

using Rgb = std::array<double, 3>;
constexpr double pi = std::numbers::pi;
constexpr std::size_t most_lobes = 16;
constexpr std::string_view form = "lafortune:CX:CY:CZ:N[:SCALE],...[,diffuse:ALBEDO]";

[[noreturn]] void refuse(std::string_view text, const std::string& what) {
  throw Error(fmt::format("BRDF 'lafortune:{}': {}; its form is {}", text, what, form));
}

// One number for all channels or three.
Rgb colour_of(std::string_view text, const std::vector<double>& numbers, std::size_t first) {
  const std::size_t count = numbers.size() - first;
  if (count == 1) return {numbers[first], numbers[first], numbers[first]};
  if (count != 3) refuse(text, "a colour is one number or three (1:0.5:0.25)");
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

std::vector<double> numbers_of(std::string_view text, const std::vector<std::string_view>& parts,
                               std::size_t first) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < parts.size(); ++i) {
    const std::optional<double> number = spec_number(parts[i]);
    if (!number) refuse(text, fmt::format("'{}' is not a number", parts[i]));
    numbers.push_back(*number);
  }
  return numbers;
}

bool within(const Rgb& colour, double high) {
  return std::all_of(colour.begin(), colour.end(), [&](double c) { return c >= 0 && c <= high; });
}

LafortuneLobe parse_lobe(std::string_view text, const std::vector<std::string_view>& parts) {
  const std::vector<double> numbers = numbers_of(text, parts, 0);
  if (numbers.size() < 4) refuse(text, "a lobe has at least four numbers");
  LafortuneLobe lobe{numbers[0], numbers[1], numbers[2], numbers[3], {1, 1, 1}};
  if (numbers.size() > 4) lobe.scale = colour_of(text, numbers, 4);
  if (!(lobe.exponent >= 0 && lobe.exponent <= 1e5)) refuse(text, "N must lie in [0, 100000]");
  const double largest = std::max({std::abs(lobe.cx), std::abs(lobe.cy), std::abs(lobe.cz)});
  if (!(largest <= 2 && std::pow(largest, lobe.exponent) <= 1e6))
    refuse(text, "CX, CY and CZ must lie in [-2, 2], their N-th powers within 1e6");
  if (!within(lobe.scale, 100)) refuse(text, "a scale must lie in [0, 100]");
  return lobe;
}

}  // namespace

std::array<double, 3> evaluate(const LafortuneBrdf& brdf, LocalVec light, LocalVec view) {
  Rgb value{};
  if (light.z <= 0 || view.z <= 0) return value;
  for (int c = 0; c < 3; ++c) value[c] = brdf.diffuse_albedo[c] / pi;
  for (const LafortuneLobe& lobe : brdf.lobes) {
    const double product = dot(lobe.axis(view), light);
    if (product <= 0) continue;
    const double power = (lobe.exponent + 2) / (2 * pi) * std::pow(product, lobe.exponent);
    for (int c = 0; c < 3; ++c) value[c] += lobe.scale[c] * power;
  }
  return value;
}

bool is_isotropic(const LafortuneBrdf& brdf) {
  return std::all_of(brdf.lobes.begin(), brdf.lobes.end(),
                     [](const LafortuneLobe& lobe) { return lobe.cx == lobe.cy; });
}

IsotropicBrdf make_lafortune_brdf(const LafortuneBrdf& brdf) {
  if (!is_isotropic(brdf))
    throw Error("a Lafortune BRDF with CX unlike CY is anisotropic: it needs tangents");
  double width = 1;
  for (const LafortuneLobe& lobe : brdf.lobes)
    width = std::min(width, 1 / std::sqrt(std::max(1.0, lobe.exponent)));
  const auto value = [brdf](double cos_light, double cos_view, double azimuth) {
    const double sin_light = std::sqrt(std::max(0.0, 1 - cos_light * cos_light));
    const double sin_view = std::sqrt(std::max(0.0, 1 - cos_view * cos_view));
    return evaluate(brdf, {sin_light * std::cos(azimuth), sin_light * std::sin(azimuth), cos_light},
                    {sin_view, 0, cos_view});
  };
  return {describe(brdf), value, width};
}

LafortuneBrdf parse_lafortune(std::string_view text) {
  constexpr std::string_view prefix = "lafortune:";
  if (text.substr(0, prefix.size()) == prefix) text.remove_prefix(prefix.size());
  LafortuneBrdf brdf;
  for (std::string_view item : split_spec(text, ',')) {
    const std::vector<std::string_view> parts = split_spec(item, ':');
    if (parts[0] == "diffuse") {
      brdf.diffuse_albedo = colour_of(text, numbers_of(text, parts, 1), 0);
      if (!within(brdf.diffuse_albedo, 1)) refuse(text, "an albedo must lie in [0, 1]");
    } else {
      brdf.lobes.push_back(parse_lobe(text, parts));
    }
  }
  if (brdf.lobes.empty() || brdf.lobes.size() > most_lobes) refuse(text, "1 to 16 lobes are needed");
  return brdf;
}

std::string describe(const LafortuneBrdf& brdf) {
  if (brdf.lobes.empty()) return "lafortune without lobes";
  const auto [low, high] = std::minmax_element(
      brdf.lobes.begin(), brdf.lobes.end(),
      [](const LafortuneLobe& a, const LafortuneLobe& b) { return a.exponent < b.exponent; });
  if (low == high || low->exponent == high->exponent)
    return fmt::format("lafortune, {} lobe{}, N {:g}", brdf.lobes.size(), brdf.lobes.size() > 1 ? "s" : "",
                       low->exponent);
  return fmt::format("lafortune, {} lobes, N {:g} to {:g}", brdf.lobes.size(), low->exponent, high->exponent);
}

}  // namespace welkin
