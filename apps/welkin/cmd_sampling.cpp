#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "commands.h"
#include "environment_options.h"
#include "flat_file.h"

#include <welkin/envmap/importance/sampling_table.h>
#include <welkin/error.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>
#include <welkin/sampling/sequence.h>
#include <welkin/sphere/equirect.h>

// welkin sampling: tables that sample an environment by importance, the shader code for them, and how well that works.

namespace welkin {
namespace {

struct SamplingCommand {
  EnvironmentInput in;
  std::string output, glsl, picture, form = "cdf", density = "luminance-solid-angle", weights = "rec709";
  int points = 1000;
};

SamplingTableForm form_of(const SamplingCommand& command) {
  return command.form == "rows"  ? SamplingTableForm::rows
         : command.form == "cdf" ? SamplingTableForm::cdf
                                 : SamplingTableForm::alias;
}

EnvironmentSamplerOptions options_of(const SamplingCommand& command) {
  EnvironmentSamplerOptions options;
  if (command.density == "luminance") options.density = EnvironmentDensity::luminance;
  if (command.weights == "ntsc") options.luminance_weights = {0.2989f, 0.5866f, 0.1145f};
  return options;
}

std::vector<std::uint8_t> encode_table(const SamplingCommand& command, const Image& table) {
  if (extension_of(command.output) == ".exr") return encode_exr(table, {ExrPixelType::single_float, 1});
  return encode_ktx2_table(table, {{"WelkinQuantity", "sampling table " + command.form}});
}

void check(const SamplingCommand& command) {
  if (command.output.empty() && command.glsl.empty() && command.picture.empty())
    throw CLI::ValidationError("-o", "name a table to write, or --glsl or --picture");
  const std::string extension = extension_of(command.output);
  if (!command.output.empty() && extension != ".exr" && extension != ".ktx2")
    throw CLI::ValidationError("-o", command.output + " is neither .exr nor .ktx2");
  if (!command.picture.empty() && extension_of(command.picture) != ".png")
    throw CLI::ValidationError("--picture", command.picture + " is not a .png");
  if (!command.glsl.empty() && (command.glsl == command.output || command.glsl == command.picture))
    throw CLI::ValidationError("--glsl", command.glsl + " is the name of another output");
  for (const std::string& file : {command.output, command.glsl, command.picture})
    check_output(file, command.in.input);
}

// Relative standard deviation of one sample of the integral of luminance times cos^exponent about `axis`, from the sums
// over texels: the second moment of f / p is the integral of f^2 / p.
struct Noise {
  double irradiance = 0, lobe = 0;
};
Noise noise_of(const Image& map, const EnvironmentSampler* sampler) {
  std::array<double, 2> first{}, second{};
  for (int y = 0; y < map.height; ++y) {
    const double solid_angle = equirect_texel_solid_angle(map.width, map.height, y);
    for (int x = 0; x < map.width; ++x) {
      const float* p = map.at(x, y);
      const Vec3 d = equirect_direction({(x + 0.5) / map.width, (y + 0.5) / map.height});
      const Vec3f direction{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
      const double radiance = luminance(Rgb{p[0], p[1], p[2]});
      if (!(radiance > 0)) continue;
      const double pdf = sampler != nullptr ? sampler->pdf(direction) : 1 / (4 * std::numbers::pi);
      const std::array<double, 2> weights{std::max(0.0, d.y), std::pow(std::max(0.0, d.x), 100)};
      for (int k = 0; k < 2; ++k) {
        first[k] += radiance * weights[k] * solid_angle;
        second[k] += radiance * weights[k] * radiance * weights[k] / pdf * solid_angle;
      }
    }
  }
  const auto deviation = [&](int k) {
    return std::sqrt(std::max(0.0, second[k] / (first[k] * first[k]) - 1));
  };
  return {deviation(0), deviation(1)};
}

void print_noise(const Image& map, const EnvironmentSamplerOptions& chosen) {
  fmt::print("relative standard deviation of one sample     irradiance up   cos^100 lobe along +X\n");
  const auto line = [](const char* name, Noise noise) {
    fmt::print("{:<44} {:>14.3f} {:>23.3f}\n", name, noise.irradiance, noise.lobe);
  };
  EnvironmentSamplerOptions options = chosen;
  for (auto density : {EnvironmentDensity::luminance_solid_angle, EnvironmentDensity::luminance}) {
    options.density = density;
    const EnvironmentSampler sampler(map, options);
    line(density == EnvironmentDensity::luminance ? "luminance" : "luminance x solid angle",
         noise_of(map, &sampler));
  }
  line("uniform over the sphere", noise_of(map, nullptr));
}

void print_range(const EnvironmentSampler& sampler) {
  const Image& map = sampler.map();
  float low = INFINITY, high = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const float pdf = sampler.pdf(sampler.direction_in({x, y}, {0.5f, 0.5f}));
      if (pdf > 0) low = std::min(low, pdf);
      high = std::max(high, pdf);
    }
  fmt::print("pdf {:.4g} to {:.4g} per steradian where there is light\n", low, high);
}

// A map of at most about 512 columns with a red dot for each sample of a low-discrepancy sequence.
Image draw(const EnvironmentSampler& sampler, int points) {
  const Image& map = sampler.map();
  const int step = std::max(1, map.width / 512);
  Image picture(std::max(1, map.width / step), std::max(1, map.height / step));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) std::copy_n(map.at(x * step, y * step), 3, picture.at(x, y));
  const float red = 4 * static_cast<float>(sampler.mean_luminance());
  for (int i = 0; i < points; ++i) {
    const Point2 u = r2_point(static_cast<std::uint64_t>(i));
    const auto at = sampler.texel_of(sampler
                                         .sample({std::min(static_cast<float>(u[0]), 0.9999999f),
                                                  std::min(static_cast<float>(u[1]), 0.9999999f)})
                                         .direction);
    for (int k = 0; k < 4; ++k) {
      float* p = picture.at(std::min(at.x / step + k % 2, picture.width - 1),
                            std::min(at.y / step + k / 2, picture.height - 1));
      p[0] = red;
      p[1] = p[2] = 0;
    }
  }
  return picture;
}

void run(const SamplingCommand& command) {
  check(command);
  const Environment environment = load(command.in);
  const EnvironmentSamplerOptions options = options_of(command);
  std::vector<OutputFile> files;
  Image table;
  if (!command.output.empty()) {
    table = make_sampling_table(environment.radiance, form_of(command), options);
    files.push_back({command.output, encode_table(command, table)});
  }
  if (!command.glsl.empty()) {
    const std::string code = sampling_table_glsl(form_of(command), options);
    files.push_back({command.glsl, {code.begin(), code.end()}});
  }
  const EnvironmentSampler sampler(environment.radiance, options);
  if (!command.picture.empty())
    files.push_back({command.picture, encode_flat(command.picture, draw(sampler, command.points))});
  write_files(files);
  if (!table.empty())
    fmt::print("{}: {} x {}, {} channel{}, {} bytes as floats\n", command.output, table.width, table.height,
               table.channels, table.channels > 1 ? "s" : "", table.pixels.size() * sizeof(float));
  print_range(sampler);
  print_noise(environment.radiance, options);
}

}  // namespace

void add_sampling_command(CLI::App& app) {
  auto command = std::make_shared<SamplingCommand>();
  CLI::App* sub =
      app.add_subcommand("sampling", "Tables and shader code that sample an environment by importance");
  add_environment_options(*sub, command->in);
  sub->add_option("-o,--output", command->output, "Table to write: .exr or .ktx2, single floats");
  sub->add_option("--form", command->form,
                  "rows: means of the rows; cdf: CDFs of rows and columns; alias: one look-up")
      ->check(CLI::IsMember({"rows", "cdf", "alias"}))
      ->capture_default_str();
  sub->add_option("--density", command->density, "What the density follows")
      ->check(CLI::IsMember({"luminance-solid-angle", "luminance"}))
      ->capture_default_str();
  sub->add_option("--weights", command->weights,
                  "Of red, green, blue: rec709, or ntsc (0.2989 0.5866 0.1145)")
      ->check(CLI::IsMember({"rec709", "ntsc"}))
      ->capture_default_str();
  sub->add_option("--glsl", command->glsl, "File for the GLSL ES 3.00 functions that sample with this table");
  sub->add_option("--picture", command->picture, "Picture of the map with samples on it: .png");
  sub->add_option("--points", command->points, "Samples on the picture")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  sub->footer(
      "Example: welkin sampling sunset.hdr --form alias -o sunset_alias.exr --glsl sunset_alias.glsl "
      "--picture samples.png");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
