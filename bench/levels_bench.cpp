#include <algorithm>
#include <map>
#include <random>

#include "levels_figure.h"
#include "measure.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/ibl.h>
#include <welkin/envmap/level_law.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/transform.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/resample.h>
#include <welkin/sphere/sphere_points.h>

// How many levels should a specular map have? The error that a consumer sees, trilinear look-up at random directions
// and roughnesses against brute force, for every number of levels. This is what default_levels() rests on.
// Usage: bench_levels [--svg FILE]

namespace {

using namespace welkin;

constexpr int maps = 3, bands = 10;
constexpr int samples_a_band = 120;
constexpr double smallest_roughness = 0.05;  // below, the map's own texels are wider than the lobe

// Noise as pictures have it: log-normal, variance falling with the square of frequency.
Image noise_map() {
  Spectrum spectrum(160, 3);
  std::mt19937 random(7);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  for (int m = 0; m <= spectrum.max_degree; ++m)
    for (int l = std::max(m, 1); l <= spectrum.max_degree; ++l)
      for (int c = 0; c < 3; ++c) {
        const double re = uniform(), im = m == 0 ? 0 : uniform();
        spectrum.values[spectrum.index(l, m) * 3 + c] = {3 * re / l, 3 * im / l};
      }
  const SphereGrid grid = synthesize(spectrum, 512, 1024);
  Image map(1024, 512);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = std::exp(grid.at(y, x)[c]);
  return map;
}

struct Sample {
  Vec3 direction;
  double perceptual_roughness = 0;
  std::vector<double> truth;
};

// Roughness from smallest_roughness to 1, stratified; every band has its own directions all over the sphere.
std::vector<Sample> make_samples(const Image& map) {
  std::vector<Sample> samples(bands * samples_a_band);
  const std::vector<Vec3> directions = sphere_points(static_cast<int>(samples.size()), 3);
  parallel_for(samples.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Sample& sample = samples[i];
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(samples.size());
      sample.direction = directions[i];
      sample.perceptual_roughness = smallest_roughness + (1 - smallest_roughness) * share;
      const ZonalKernel kernel = make_ggx_kernel(sample.perceptual_roughness * sample.perceptual_roughness);
      sample.truth = filter_brute_force(map, std::span(&sample.direction, 1), std::span(&kernel, 1));
    }
  });
  return samples;
}

struct LookupError {
  double mean_of_bands = 0;  // of the relative RMS in each band of roughness
  double worst_band = 0;
};

LookupError lookup_error(const CubeMips& specular, const std::vector<Sample>& samples) {
  LookupError error;
  const int levels = static_cast<int>(specular.levels.size());
  for (int band = 0; band < bands; ++band) {
    double squared_error = 0, squared_truth = 0;
    for (int i = band * samples_a_band; i < (band + 1) * samples_a_band; ++i) {
      const Sample& sample = samples[i];
      float value[3];
      look_up_cube(specular, sample.direction,
                   perceptual_roughness_to_level(LevelLaw::linear, sample.perceptual_roughness, levels,
                                                 specular.size()),
                   value);
      for (int c = 0; c < 3; ++c) {
        squared_error += (value[c] - sample.truth[c]) * (value[c] - sample.truth[c]);
        squared_truth += sample.truth[c] * sample.truth[c];
      }
    }
    const double relative = std::sqrt(squared_error / squared_truth);
    error.mean_of_bands += relative / bands;
    error.worst_band = std::max(error.worst_band, relative);
  }
  return error;
}

int full_levels(int size) {
  int levels = 1;
  while (size >> levels) ++levels;
  return levels;
}

std::vector<FilterTarget> targets_of(int size, int levels) {
  std::vector<FilterTarget> targets;
  for (int k = 1; k < levels; ++k) {
    const double r = level_to_perceptual_roughness(LevelLaw::linear, k, levels, size);
    targets.push_back({make_ggx_kernel(r * r), size >> k});
  }
  return targets;
}

// One row a number of levels.
bench::Curve bench_size(bench::Report& report, const Image& map, const std::string& name, int size,
                        const std::vector<Sample>& samples) {
  bench::Curve curve{name, size, default_levels(size), {}};
  const Cube mirror = equirect_to_cube(map, size);
  for (int levels = 4; levels <= full_levels(size); ++levels) {
    CubeMips specular;
    specular.levels.push_back(mirror);
    for (Cube& cube : filter_environment(map, targets_of(size, levels)))
      specular.levels.push_back(std::move(cube));
    const LookupError error = lookup_error(specular, samples);
    report.note(fmt::format("{:<8} {:>5} {:>7} {:>11.2f} % {:>11.2f} % {}", name, size, levels,
                            100 * error.mean_of_bands, 100 * error.worst_band,
                            levels == default_levels(size) ? "  default" : ""));
    curve.points.push_back({levels, error.mean_of_bands});
  }
  return curve;
}

// What default_levels() must be: near the best for each size, over all maps (geometric mean of their errors).
void check_default(bench::Report& report, const std::vector<bench::Curve>& curves, int size) {
  std::map<int, double> log_errors;
  for (const bench::Curve& curve : curves)
    if (curve.size == size)
      for (const auto& [levels, error] : curve.points) log_errors[levels] += std::log(error) / maps;
  const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto best = std::min_element(log_errors.begin(), log_errors.end(), smaller);
  std::string all;
  for (const auto& [levels, error] : log_errors)
    all += fmt::format("  {}: {:.2f} %", levels, 100 * std::exp(error));
  report.note(fmt::format("size {}, all maps {}", size, all));
  report.check(fmt::format("  default {} levels over the best, {}", default_levels(size), best->first),
               std::exp(log_errors[default_levels(size)] - best->second) - 1, 0.15);
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  report.note("trilinear look-up against brute force, ggx, linear law, perceptual roughness 0.05 to 1");
  report.note(
      fmt::format("{:<8} {:>5} {:>7} {:>13} {:>13}", "map", "size", "levels", "relative RMS", "worst band"));
  std::vector<bench::Curve> curves;
  for (const std::string name : {"day", "studio", "noise"}) {
    const Image map =
        name == "noise" ? noise_map() : load_environment("sky:" + name + ",size=1024x512").radiance;
    const std::vector<Sample> samples = make_samples(map);
    for (int size : {128, 256, 512}) curves.push_back(bench_size(report, map, name, size, samples));
  }
  for (int size : {128, 256, 512}) check_default(report, curves, size);
  if (argc == 3 && std::string(argv[1]) == "--svg") bench::write_levels_figure(argv[2], curves);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_levels: {}\n", error.what());
  return 1;
}
