#include "lights_json.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace welkin {
namespace {

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

// JSON has doubles; what was measured has about six digits.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  return std::stod(fmt::format("{:.7g}", value));
}

}  // namespace

nlohmann::ordered_json lights_to_json(std::span<const DirectionalLight> lights) {
  auto list = nlohmann::ordered_json::array();
  for (const DirectionalLight& l : lights) {
    nlohmann::ordered_json light;
    light["direction"] = {rounded(l.direction.x), rounded(l.direction.y), rounded(l.direction.z)};
    light["angular_radius_degrees"] = rounded(degrees(l.angular_radius));
    light["irradiance"] = {rounded(l.irradiance[0]), rounded(l.irradiance[1]), rounded(l.irradiance[2])};
    light["illuminance"] = rounded(l.illuminance);
    light["color"] = {rounded(l.color[0]), rounded(l.color[1]), rounded(l.color[2])};
    light["share"] = rounded(l.share);
    list.push_back(std::move(light));
  }
  return list;
}

nlohmann::ordered_json recombination_to_json(const RecombinationErrors& e) {
  return {{"as_directions", {{"rms", e.directional_rms}, {"max", e.directional_max}}},
          {"as_discs", {{"rms", e.disc_rms}, {"max", e.disc_max}}},
          {"of", "the map's largest irradiance (luminance)"},
          {"largest_irradiance", e.largest_irradiance}};
}

void print_lights(std::span<const DirectionalLight> lights) {
  if (lights.empty()) {
    fmt::print("no light: nothing in this map is compact and strong enough (see --light-radius)\n");
    return;
  }
  fmt::print("light  elevation  azimuth   radius  illuminance   share  color\n");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const DirectionalLight& l = lights[i];
    fmt::print("{:>5} {:>10.2f} {:>8.2f} {:>8.3f} {:>12.5g} {:>6.1f}%  {:.3f} {:.3f} {:.3f}\n", i,
               degrees(std::asin(l.direction.y)), degrees(std::atan2(l.direction.z, l.direction.x)),
               degrees(l.angular_radius), l.illuminance, 100 * l.share, l.color[0], l.color[1], l.color[2]);
  }
  fmt::print(
      "degrees; azimuth from +X towards +Z; illuminance of a surface that faces the light, in the map's "
      "unit\n");
}

}  // namespace welkin
