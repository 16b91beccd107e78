#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <welkin/envmap/environment.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/equirect.h>

#include "commands.h"

// welkin info: what an environment holds. All means and sums are over the sphere, by exact texel solid angles.

namespace welkin {
namespace {

struct InfoCommand {
  std::string input;
  bool json = false;
};

using Rgb = std::array<double, 3>;

double luminance(const Rgb& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// Sums over one or more rows; added up in row order.
struct Sums {
  Rgb integral{}, irradiance_up{}, irradiance_down{};  // of L, and of L cos over the upper and the lower half
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;  // of any channel
  double brightest = -1;                                                   // luminance of the brightest texel
  int brightest_x = 0, brightest_y = 0;

  void add(const Sums& later) {
    for (int c = 0; c < 3; ++c) {
      integral[c] += later.integral[c];
      irradiance_up[c] += later.irradiance_up[c];
      irradiance_down[c] += later.irradiance_down[c];
    }
    smallest = std::min(smallest, later.smallest);
    largest = std::max(largest, later.largest);
    if (later.brightest <= brightest) return;
    brightest = later.brightest;
    brightest_x = later.brightest_x;
    brightest_y = later.brightest_y;
  }
};

// The integral of |cos theta| over a texel whose theta runs from t0 to t1, both in one hemisphere: the width in phi
// times half the difference of sin^2. A middle row (odd height) is cut at the horizon.
double cosine_integral(int width, double t0, double t1) {
  return std::numbers::pi / width * std::abs(std::pow(std::sin(t1), 2) - std::pow(std::sin(t0), 2));
}

Sums sum_row(const Image& image, int y) {
  Sums sums;
  Rgb row{};
  for (int x = 0; x < image.width; ++x) {
    const float* pixel = image.at(x, y);
    const Rgb rgb{pixel[0], pixel[1], pixel[2]};
    for (int c = 0; c < 3; ++c) {
      row[c] += rgb[c];
      sums.smallest = std::min(sums.smallest, rgb[c]);
      sums.largest = std::max(sums.largest, rgb[c]);
    }
    if (luminance(rgb) > sums.brightest) {
      sums.brightest = luminance(rgb);
      sums.brightest_x = x;
    }
  }
  sums.brightest_y = y;
  const double horizon = std::numbers::pi / 2;
  const double t0 = std::numbers::pi * y / image.height, t1 = std::numbers::pi * (y + 1) / image.height;
  const double up = t0 < horizon ? cosine_integral(image.width, t0, std::min(t1, horizon)) : 0;
  const double down = t1 > horizon ? cosine_integral(image.width, std::max(t0, horizon), t1) : 0;
  for (int c = 0; c < 3; ++c) {
    sums.integral[c] = row[c] * equirect_texel_solid_angle(image.width, image.height, y);
    sums.irradiance_up[c] = row[c] * up;
    sums.irradiance_down[c] = row[c] * down;
  }
  return sums;
}

Sums sum_sphere(const Image& image) {
  const auto rows = parallel_partials<Sums>(
      static_cast<std::size_t>(image.height), 1,
      [&](Sums& sums, std::size_t begin, std::size_t) { sums = sum_row(image, static_cast<int>(begin)); });
  Sums total;
  for (const Sums& row : rows) total.add(row);
  return total;
}

struct Info {
  Rgb mean{};
  double brightest_share = 0;  // of the integral of luminance
  Vec3 brightest_direction;
};

Info derive(const Image& image, const Sums& sums) {
  Info info;
  for (int c = 0; c < 3; ++c) info.mean[c] = sums.integral[c] / (4 * std::numbers::pi);
  const double energy = luminance(sums.integral);
  const double texel = equirect_texel_solid_angle(image.width, image.height, sums.brightest_y);
  info.brightest_share = energy > 0 ? sums.brightest * texel / energy : 0;
  info.brightest_direction =
      equirect_direction({(sums.brightest_x + 0.5) / image.width, (sums.brightest_y + 0.5) / image.height});
  return info;
}

void print_json(const Environment& environment, const Sums& sums, const Info& info) {
  const Vec3& d = info.brightest_direction;
  const nlohmann::ordered_json json{{"source", environment.source},
                                    {"description", environment.description},
                                    {"width", environment.radiance.width},
                                    {"height", environment.radiance.height},
                                    {"range", {sums.smallest, sums.largest}},
                                    {"mean_radiance", info.mean},
                                    {"irradiance_up", sums.irradiance_up},
                                    {"irradiance_down", sums.irradiance_down},
                                    {"luminance_integral", luminance(sums.integral)},
                                    {"brightest_texel",
                                     {{"x", sums.brightest_x},
                                      {"y", sums.brightest_y},
                                      {"direction", {d.x, d.y, d.z}},
                                      {"luminance", sums.brightest},
                                      {"share_of_luminance_integral", info.brightest_share}}},
                                    {"faults",
                                     {{"nan", environment.faults.nan},
                                      {"infinite", environment.faults.infinite},
                                      {"negative", environment.faults.negative}}},
                                    {"warnings", environment.warnings}};
  fmt::print("{}\n", json.dump(2));
}

std::string triple(const Rgb& rgb) { return fmt::format("{:.5g} {:.5g} {:.5g}", rgb[0], rgb[1], rgb[2]); }

void print_text(const Environment& environment, const Sums& sums, const Info& info) {
  const Vec3& d = info.brightest_direction;
  fmt::print("{}: {}\n", environment.source, environment.description);
  fmt::print("  range              {:.5g} to {:.5g}\n", sums.smallest, sums.largest);
  fmt::print("  mean radiance      {}\n", triple(info.mean));
  fmt::print("  irradiance up      {}\n", triple(sums.irradiance_up));
  fmt::print("  irradiance down    {}\n", triple(sums.irradiance_down));
  fmt::print("  energy             {:.5g} (integral of luminance over the sphere)\n",
             luminance(sums.integral));
  fmt::print(
      "  brightest texel    {}, {} towards ({:.3f}, {:.3f}, {:.3f}): luminance {:.5g}, {:.3g} % of the "
      "energy\n",
      sums.brightest_x, sums.brightest_y, d.x, d.y, d.z, sums.brightest, 100 * info.brightest_share);
  const PixelFaults& faults = environment.faults;
  fmt::print("  faults             {} NaN, {} infinite, {} negative{}\n", faults.nan, faults.infinite,
             faults.negative, faults.total() > 0 ? " (repaired for the figures above)" : "");
}

void run(const InfoCommand& command) {
  const Environment environment = load_environment(command.input);
  const Sums sums = sum_sphere(environment.radiance);
  const Info info = derive(environment.radiance, sums);
  for (const std::string& warning : environment.warnings) {
    fmt::print(stderr, "welkin: warning: {}: {}\n", environment.source, warning);
  }
  command.json ? print_json(environment, sums, info) : print_text(environment, sums, info);
}

}  // namespace

void add_info_command(CLI::App& app) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App* sub = app.add_subcommand(
      "info", "Say what an environment holds: size, range, energy, brightest texel, faults");
  sub->add_option("INPUT", command->input, "An environment map, or a built-in sky such as sky:day")
      ->required();
  sub->add_flag("--json", command->json, "Print JSON");
  sub->footer("Example: welkin info park.hdr --json");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
