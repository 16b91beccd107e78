#include <array>
#include <filesystem>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "coefficients_figure.h"
#include "measure.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/light_fit.h>
#include <welkin/envmap/lights.h>
#include <welkin/error.h>
#include <welkin/image/output_file.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/nonnegative.h>
#include <welkin/sh/projection.h>
#include <welkin/sh/window.h>
#include <welkin/sh/zh3.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/sphere_points.h>

// What a few numbers hold of an environment's irradiance: nine coefficients as they are, under windows, fitted
// without negative values, ZH3, with lights beside them, 25 and 49 coefficients. Errors are those of luminance against the
// exact sum over all texels, over the map's largest irradiance.
// Usage: bench_coefficients [--svg FILE] [MAP ...]      without maps: the built-in skies and a hundred random maps

namespace {

using namespace welkin;

constexpr double pi = std::numbers::pi;

template <class T>
double luminance(const T& rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

struct Truth {
  std::vector<Vec3> normals;
  std::vector<double> irradiance;  // luminance
  double largest = 0;
};

Truth make_truth(const Image& map, int normals) {
  Truth truth;
  truth.normals = sphere_points(normals);
  const ZonalKernel lambert = make_lambert_kernel();
  const std::vector<double> values = filter_brute_force(map, truth.normals, std::span(&lambert, 1));
  for (std::size_t i = 0; i < truth.normals.size(); ++i)
    truth.irradiance.push_back(pi * luminance(std::span(values).subspan(3 * i, 3)));
  truth.largest = *std::max_element(truth.irradiance.begin(), truth.irradiance.end());
  return truth;
}

bench::CoefficientErrors compare(const Truth& truth, const ShCoefficients& irradiance,
                                 std::span<const DirectionalLight> lights = {}) {
  bench::CoefficientErrors e;
  e.least = 1;
  for (std::size_t i = 0; i < truth.normals.size(); ++i) {
    std::array<double, 3> rgb{};
    evaluate(irradiance, truth.normals[i], rgb);
    double here = luminance(rgb);
    for (const DirectionalLight& light : lights)
      here += luminance(directional_irradiance(light, truth.normals[i]));
    const double error = std::abs(here - truth.irradiance[i]) / truth.largest;
    e.rms += error * error / static_cast<double>(truth.normals.size());
    e.largest = std::max(e.largest, error);
    e.least = std::min(e.least, here / truth.largest);
  }
  e.rms = std::sqrt(e.rms);
  return e;
}

ShCoefficients irradiance_of(const ShCoefficients& radiance) {
  return convolve(radiance, cosine_lobe(radiance.max_degree));
}

constexpr std::array<const char*, 14> method_names{"nine",
                                                   "nine, Hann window of 3",
                                                   "nine, Lanczos window of 3",
                                                   "nine, weakest Laplacian window",
                                                   "nine, non-negative fit",
                                                   "ZH3, published axis",
                                                   "ZH3, best axis",
                                                   "ZH3, best axis, non-negative",
                                                   "nine and the sun",
                                                   "nine and the sun and its glow",
                                                   "nine and 1 fitted light",
                                                   "nine and 2 fitted lights",
                                                   "25",
                                                   "49"};

bench::MapErrors errors_of(const std::string& name, const Image& map, int normals) {
  const Truth truth = make_truth(map, normals);
  const ShCoefficients radiance = project_equirect(map, 6), nine = irradiance_of(resize(radiance, 2));
  bench::MapErrors out{name, {}};
  const auto add = [&](const ShCoefficients& irradiance, std::span<const DirectionalLight> lights = {}) {
    out.errors.push_back(compare(truth, irradiance, lights));
  };
  add(nine);
  add(convolve(nine, hann_window(3, 2)));
  add(convolve(nine, lanczos_window(3, 2)));
  add(laplacian_windowed(nine, weakest_laplacian(nine, WindowScope::each_channel)));
  add(nonnegative_fit(nine));
  add(zh3_to_sh(fit_zh3(nine, zh3_luminance_axis(nine))));
  const Zh3 best = fit_zh3(nine, zh3_best_axis(nine));
  add(zh3_to_sh(best));
  add(zh3_to_sh(nonnegative_zh3(best)));
  for (const LightOptions& options : {LightOptions{}, LightOptions{2, 15, 0.01}}) {
    const ExtractedLights extracted = extract_lights(map, options);
    add(irradiance_of(project_equirect(extracted.residual, 2)), extracted.lights);
  }
  for (int lights : {1, 2}) {
    const LightFit fit = fit_lights(map, lights);
    add(irradiance_of(fit.rest), fit.lights);
  }
  add(irradiance_of(resize(radiance, 4)));
  add(irradiance_of(radiance));
  return out;
}

// A sky of a random colour with one to six lights of random place, size (2 to 60 degrees), strength and colour.
Image random_map(std::mt19937& engine) {
  std::uniform_real_distribution<double> uniform(0, 1);
  struct Lobe {
    Vec3 centre;
    double sharpness;
    std::array<double, 3> color;
  };
  std::vector<Lobe> lobes;
  const int count = 1 + static_cast<int>(uniform(engine) * 6);
  for (int i = 0; i < count; ++i) {
    const double y = 2 * uniform(engine) - 1, phi = 2 * pi * uniform(engine), r = std::sqrt(1 - y * y);
    const double size = std::exp(std::log(2.0) + std::log(30.0) * uniform(engine)) * pi / 180;
    const double power = std::exp(4 * uniform(engine)) / (size * size);
    lobes.push_back({{r * std::cos(phi), y, r * std::sin(phi)},
                     1 / (size * size),
                     {power * (0.3 + uniform(engine)), power * (0.3 + uniform(engine)),
                      power * (0.3 + uniform(engine))}});
  }
  Image map(128, 64);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vec3 d = equirect_direction({(x + 0.5) / map.width, (y + 0.5) / map.height});
      for (int c = 0; c < 3; ++c) {
        double value = 0.5 + 0.5 * d.y;
        for (const Lobe& lobe : lobes)
          value += lobe.color[c] * std::exp(lobe.sharpness * (dot(d, lobe.centre) - 1));
        map.at(x, y)[c] = static_cast<float>(value);
      }
    }
  return map;
}

void print(const bench::MapErrors& map) {
  fmt::print("{}\n", map.name);
  for (std::size_t i = 0; i < method_names.size(); ++i) {
    const bench::CoefficientErrors& e = map.errors[i];
    fmt::print("  {:<32} RMS {:>6.2f} %  largest {:>6.2f} %  least {:>6.2f} %\n", method_names[i],
               100 * e.rms, 100 * e.largest, 100 * e.least);
  }
  std::fflush(stdout);
}

// Of the random maps: mean RMS, and the worst of the others.
bench::MapErrors summary(const std::vector<bench::MapErrors>& maps) {
  bench::MapErrors out{fmt::format("{} random maps (mean RMS, largest of all)", maps.size()), {}};
  for (std::size_t i = 0; i < method_names.size(); ++i) {
    bench::CoefficientErrors e;
    e.least = 1;
    for (const bench::MapErrors& map : maps) {
      e.rms += map.errors[i].rms / static_cast<double>(maps.size());
      e.largest = std::max(e.largest, map.errors[i].largest);
      e.least = std::min(e.least, map.errors[i].least);
    }
    out.errors.push_back(e);
  }
  return out;
}

struct Arguments {
  std::string svg;
  std::vector<std::string> maps;
};

Arguments parse(int count, char** values) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    if (std::string(values[i]) == "--svg" && i + 1 < count)
      arguments.svg = values[++i];
    else
      arguments.maps.emplace_back(values[i]);
  }
  if (arguments.maps.empty())
    for (const char* sky : {"sky:overcast", "sky:studio", "sky:day,elevation=60", "sky:day,elevation=20",
                            "sky:day,elevation=5"})
      arguments.maps.emplace_back(std::string(sky) + ",size=512x256");
  return arguments;
}

int run(const Arguments& arguments) {
  bench::Report report;
  std::vector<bench::MapErrors> maps, random;
  for (const std::string& name : arguments.maps) {
    const std::string label = name.starts_with("sky:") ? name.substr(0, name.find(",size"))
                                                       : std::filesystem::path(name).stem().string();
    maps.push_back(errors_of(label, load_environment(name).radiance, 600));
    print(maps.back());
  }
  std::mt19937 engine(1);
  for (int i = 0; i < 100; ++i) random.push_back(errors_of("random", random_map(engine), 600));
  maps.push_back(summary(random));
  print(maps.back());
  double window = 0, fit = 0;
  for (const bench::MapErrors& map : random) {
    const double plain = map.errors[0].rms;
    window += std::sqrt(std::max(0.0, map.errors[3].rms * map.errors[3].rms - plain * plain));
    fit += std::sqrt(std::max(0.0, map.errors[4].rms * map.errors[4].rms - plain * plain));
  }
  report.check("error that the non-negative fit adds, over that of the window", fit / window, 0.35);
  report.check("least value of the non-negative fit, negative", -maps.back().errors[4].least, 1e-9);
  if (!arguments.svg.empty()) write_file(arguments.svg, bench::coefficients_figure(method_names, maps));
  return report.exit_code();
}

}  // namespace

int main(int count, char** values) {
  try {
    return run(parse(count, values));
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_coefficients: {}\n", error.what());
    return 1;
  }
}
