#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "commands.h"
#include "environment_options.h"
#include "json_text.h"

#include <welkin/envmap/statistics.h>

// welkin info: what an environment holds.

namespace welkin {
namespace {

struct InfoCommand {
  EnvironmentInput in;
  bool json = false;
};

std::string rgb(const std::array<double, 3>& c) {
  return fmt::format("{:.5g} {:.5g} {:.5g}", c[0], c[1], c[2]);
}

void print_text(const Environment& e, const MapStatistics& s) {
  const Vec3 d = s.brightest_direction;
  fmt::print("{}\n", e.source);
  fmt::print("  what                {}\n", e.description);
  fmt::print("  range               {:.6g} to {:.6g}\n", static_cast<double>(e.smallest),
             static_cast<double>(e.largest));
  fmt::print("  average radiance    {}\n", rgb(s.mean_radiance));
  fmt::print("  energy (4 pi mean)  {}\n", rgb(s.energy));
  fmt::print("  irradiance up       {}\n", rgb(s.irradiance_up));
  fmt::print("  irradiance down     {}\n", rgb(s.irradiance_down));
  fmt::print(
      "  brightest texel     ({}, {}) of the equirectangular map, direction {:.4f} {:.4f} {:.4f}, elevation "
      "{:.2f} degrees\n",
      s.brightest_x, s.brightest_y, d.x, d.y, d.z, std::asin(d.y) * 180 / std::numbers::pi);
  fmt::print("  its luminance       {:.6g}, {:.3g} % of all light\n", s.brightest_luminance,
             100 * s.brightest_share);
  fmt::print("  faults              {} NaN, {} infinite, {} negative\n", e.faults.nan, e.faults.infinite,
             e.faults.negative);
}

void print_json(const Environment& e, const MapStatistics& s) {
  const Vec3 d = s.brightest_direction;
  nlohmann::ordered_json json{
      {"source", e.source},
      {"description", e.description},
      {"width", e.radiance.width},
      {"height", e.radiance.height},
      {"min_radiance", e.smallest},
      {"max_radiance", e.largest},
      {"mean_radiance", s.mean_radiance},
      {"energy", s.energy},
      {"irradiance_up", s.irradiance_up},
      {"irradiance_down", s.irradiance_down},
      {"brightest_texel", {s.brightest_x, s.brightest_y}},
      {"brightest_direction", {d.x, d.y, d.z}},
      {"brightest_luminance", s.brightest_luminance},
      {"brightest_share", s.brightest_share},
      {"faults", {{"nan", e.faults.nan}, {"infinite", e.faults.infinite}, {"negative", e.faults.negative}}},
      {"warnings", e.warnings}};
  fmt::print("{}\n", json_text(json));
}

void run(const InfoCommand& command) {
  const Environment environment = load(command.in);
  const MapStatistics statistics = map_statistics(environment.radiance);
  for (const std::string& warning : environment.warnings)
    fmt::print(stderr, "welkin: {}: warning: {}\n", environment.source, warning);
  command.json ? print_json(environment, statistics) : print_text(environment, statistics);
}

}  // namespace

void add_info_command(CLI::App& app) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App* sub = app.add_subcommand("info", "Size, range, energy, irradiance and faults of an environment");
  add_environment_options(*sub, command->in);
  sub->add_flag("--json", command->json, "Print JSON");
  sub->footer("Example: welkin info park.hdr");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
