#include <welkin/envmap/ibl.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <welkin/envmap/brute_force.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/convolution.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/cube_mips.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

template <class Work>
double timed(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void check(const char* what, int value, int low, int high) {
  if (value < low || value > high)
    throw Error(fmt::format("{} must lie in [{}, {}], not {}", what, low, high, value));
}

int full_levels(int size) {
  int levels = 1;
  while (size >> levels) ++levels;
  return levels;
}

IblOptions checked(IblOptions options) {
  check("the size", options.size, 1, 8192);
  if (options.levels == 0)
    options.levels =
        options.law == LevelLaw::logarithmic ? full_levels(options.size) : default_levels(options.size);
  check("the number of levels", options.levels, 1, full_levels(options.size));
  check("the irradiance size", options.irradiance_size, 1, 1024);
  check("the SH degree", options.sh_degree, 0, max_projection_degree);
  check("the DFG size", options.dfg_size, 1, 4096);
  return options;
}

// Level 0 is the environment; level k's kernel is that of the roughness which the level law gives it.
std::vector<IblLevel> plan_levels(const IblOptions& options) {
  std::vector<IblLevel> levels(options.levels);
  for (int k = 1; k < options.levels; ++k) {
    const double r = level_to_perceptual_roughness(options.law, k, options.levels, options.size);
    levels[k].perceptual_roughness = r;
    levels[k].alpha = r * r;
    levels[k].kernel = kernel_for_alpha(options.kernel, r * r);
  }
  return levels;
}

template <class Value>
Cube cube_by_direction(int size, Value&& value) {
  Cube cube(size);
  parallel_for(std::size_t{6} * size, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row)
      for (int x = 0; x < size; ++x) {
        const int face = static_cast<int>(row) / size, y = static_cast<int>(row) % size;
        value(cube_texel_direction(size, face, x, y), cube.at(face, x, y));
      }
  });
  return cube;
}

}  // namespace

int default_levels(int size) {
  int levels = 1;
  while ((size >> levels) >= 4) ++levels;
  return levels;
}

Cube irradiance_from_sh(const ShCoefficients& radiance, int size) {
  const ShCoefficients irradiance = convolve(radiance, cosine_lobe(2));
  return cube_by_direction(size, [&](Vec3 direction, float* texel) {
    double value[4];
    evaluate(irradiance, direction, value);
    for (int c = 0; c < 3; ++c) texel[c] = static_cast<float>(std::max(0.0, value[c]));
  });
}

Cube irradiance_brute_force(const Image& radiance, int size) {
  const ZonalKernel lambert = make_lambert_kernel();
  return cube_by_direction(size, [&](Vec3 direction, float* texel) {
    const auto value = filter_brute_force(radiance, std::span(&direction, 1), std::span(&lambert, 1));
    for (int c = 0; c < 3; ++c) texel[c] = static_cast<float>(pi * value[c]);
  });
}

IblSet make_ibl(const Image& radiance, const IblOptions& given) {
  const IblOptions options = checked(given);
  const auto progress = [&](double share) {
    if (options.filter.progress) options.filter.progress(share);
  };
  IblSet set;
  set.levels = plan_levels(options);
  set.seconds_environment =
      timed([&] { set.environment = build_mips(equirect_to_cube(radiance, options.size)); });
  progress(0.1);

  std::vector<FilterTarget> targets;
  for (int k = 1; k < options.levels; ++k) targets.push_back({set.levels[k].kernel, options.size >> k});
  if (options.diffuse == DiffuseMethod::frequency)
    targets.push_back({make_lambert_kernel(), options.irradiance_size, pi});
  FilterOptions filter = options.filter;
  filter.progress = [&](double share) { progress(0.1 + 0.7 * share); };
  std::vector<Cube> filtered = filter_environment(radiance, targets, filter, &set.filter);
  set.specular.levels.push_back(set.environment.levels.front());
  for (int k = 1; k < options.levels; ++k) {
    set.specular.levels.push_back(std::move(filtered[k - 1]));
    set.levels[k].report = set.filter.levels[k - 1];
  }
  set.seconds_sh = timed([&] { set.radiance_sh = project_equirect(radiance, options.sh_degree); });
  progress(0.85);
  set.seconds_irradiance = timed([&] {
    switch (options.diffuse) {
      case DiffuseMethod::frequency: set.irradiance = std::move(filtered.back()); break;
      case DiffuseMethod::sh:
        set.irradiance = irradiance_from_sh(project_equirect(radiance, 2), options.irradiance_size);
        break;
      case DiffuseMethod::brute_force:
        set.irradiance = irradiance_brute_force(radiance, options.irradiance_size);
        break;
    }
  });
  if (options.diffuse == DiffuseMethod::frequency) set.seconds_irradiance = set.filter.levels.back().seconds;
  set.seconds_dfg = timed([&] { set.dfg = make_dfg_table({options.dfg_size, options.dfg_form}); });
  progress(1);
  return set;
}

}  // namespace welkin
