#include <welkin/envmap/verify.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include <welkin/brdf/ggx.h>
#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/cube_steps.h>
#include <welkin/envmap/statistics.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/convolution.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/resample.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

double luminance(const double* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

double map_flux(const Image& map) { return luminance(map_statistics(map).energy.data()); }

// Running comparison of values with truths.
struct ErrorSum {
  double squared_error = 0, squared_truth = 0, largest = 0;

  void add(const float* value, const double* truth) {
    for (int c = 0; c < 3; ++c) {
      const double error = static_cast<double>(value[c]) - truth[c];
      squared_error += error * error;
      squared_truth += truth[c] * truth[c];
      largest = std::max(largest, std::abs(error));
    }
  }
  double relative_rms() const { return squared_truth > 0 ? std::sqrt(squared_error / squared_truth) : 0; }
};

struct Texel {
  int face, x, y;
};

// Half the texels near the brightest one, where errors are largest, the others anywhere; the RMS is taken over the
// latter, the maximum over all. Small levels are taken whole.
struct TexelChoice {
  std::vector<Texel> anywhere, near_brightest;
};

TexelChoice choose_texels(const Cube& cube, const VerifyOptions& options) {
  TexelChoice choice;
  const int n = cube.size;
  if (6 * n * n <= options.directions) {
    for (int i = 0; i < 6 * n * n; ++i) choice.anywhere.push_back({i / (n * n), i % n, i / n % n});
    return choice;
  }
  std::mt19937 random(options.seed);
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  for (int i = 0; i < options.directions; ++i) choice.anywhere.push_back({pick(6), pick(n), pick(n)});
  const std::size_t brightest =
      static_cast<std::size_t>(std::max_element(cube.texels.begin(), cube.texels.end()) -
                               cube.texels.begin()) /
      3;
  const int face = static_cast<int>(brightest / (static_cast<std::size_t>(n) * n));
  const int by = static_cast<int>(brightest / n % n), bx = static_cast<int>(brightest % n);
  choice.near_brightest.push_back({face, bx, by});
  for (int i = 1; i < options.directions / 2; ++i)
    choice.near_brightest.push_back(
        {face, std::clamp(bx + pick(9) - 4, 0, n - 1), std::clamp(by + pick(9) - 4, 0, n - 1)});
  return choice;
}

double add_texels(const Image& radiance, const Cube& cube, const ZonalKernel& kernel, double scale,
                  const std::vector<Texel>& texels, ErrorSum& sum) {
  std::vector<Vec3> directions;
  for (const Texel& t : texels) directions.push_back(cube_texel_direction(cube.size, t.face, t.x, t.y));
  std::vector<double> truths = filter_brute_force(radiance, directions, std::span(&kernel, 1));
  for (std::size_t i = 0; i < texels.size(); ++i) {
    for (int c = 0; c < 3; ++c) truths[3 * i + c] *= scale;
    sum.add(cube.at(texels[i].face, texels[i].x, texels[i].y), &truths[3 * i]);
  }
  return sum.largest;
}

void add_lookups(const Image& radiance, const Cube& cube, const ZonalKernel& kernel, double scale,
                 std::span<const Vec3> directions, ErrorSum& sum) {
  std::vector<double> truths = filter_brute_force(radiance, directions, std::span(&kernel, 1));
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (int c = 0; c < 3; ++c) truths[3 * i + c] *= scale;
    float value[3];
    look_up_cube(cube, directions[i], value);
    sum.add(value, &truths[3 * i]);
  }
}

LevelErrors verify_cube(const Image& radiance, const Cube& cube, const ZonalKernel& kernel, double scale,
                        const VerifyOptions& options) {
  const double flux = map_flux(radiance) * scale, mean = flux / (4 * pi);
  const TexelChoice texels = choose_texels(cube, options);
  ErrorSum centres, bright, lookups;
  const double largest = std::max(add_texels(radiance, cube, kernel, scale, texels.anywhere, centres),
                                  add_texels(radiance, cube, kernel, scale, texels.near_brightest, bright));
  add_lookups(radiance, cube, kernel, scale, sphere_points(options.directions, options.seed), lookups);
  return {centres.relative_rms(), largest / mean,         cube_energy(cube) / flux - 1,
          edge_step_ratio(cube),  lookups.relative_rms(), lookups.largest / mean};
}

// Level 0 is made of area averages, not of filtered values: what can be said of it is its energy.
LevelErrors verify_environment(const Image& radiance, const Cube& cube) {
  LevelErrors errors;
  const std::vector<double> energy = map_energy(sphere_map_from_cube(cube));
  errors.energy = luminance(energy.data()) / map_flux(radiance) - 1;
  return errors;
}

void verify_trilinear(const IblSet& set, const Image& radiance, const IblOptions& options,
                      const VerifyOptions& verify, IblErrors& errors) {
  constexpr int bands = 10;
  const int levels = static_cast<int>(set.specular.levels.size());
  if (levels < 2) return;
  const std::vector<Vec3> directions =
      sphere_points(bands * std::max(4, verify.directions / 4), verify.seed + 1);
  std::array<ErrorSum, bands> by_band;
  ErrorSum all;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    // Roughness below 0.05 is a mirror to within the map's resolution: no filtered truth to compare with.
    const double r = std::max(0.05, (static_cast<double>(i) + 0.5) / static_cast<double>(directions.size()));
    const ZonalKernel kernel = kernel_for_alpha(options.kernel, r * r);
    const auto truth = filter_brute_force(radiance, std::span(&directions[i], 1), std::span(&kernel, 1));
    float value[3];
    look_up_cube(set.specular, directions[i],
                 perceptual_roughness_to_level(options.law, r, levels, set.specular.size()), value);
    by_band[i * bands / directions.size()].add(value, truth.data());
    all.add(value, truth.data());
  }
  errors.trilinear_relative_rms = all.relative_rms();
  errors.trilinear_max_over_mean = all.largest / (map_flux(radiance) / (4 * pi));
  for (const ErrorSum& band : by_band) errors.trilinear_by_roughness.push_back(band.relative_rms());
  errors.directions += static_cast<int>(directions.size());
}

void verify_nine_coefficients(const Image& radiance, const VerifyOptions& verify, IblErrors& errors) {
  const ShCoefficients irradiance = convolve(project_equirect(radiance, 2), cosine_lobe(2));
  const std::vector<Vec3> directions = sphere_points(std::max(64, verify.directions), verify.seed + 2);
  const ZonalKernel lambert = make_lambert_kernel();
  const auto truths = filter_brute_force(radiance, directions, std::span(&lambert, 1));
  double sum = 0, largest = 0, largest_irradiance = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    double value[3], difference[3], truth[3];
    evaluate(irradiance, directions[i], value);
    for (int c = 0; c < 3; ++c) {
      truth[c] = pi * truths[3 * i + c];
      difference[c] = value[c] - truth[c];
    }
    sum += std::abs(luminance(difference));
    largest = std::max(largest, std::abs(luminance(difference)));
    largest_irradiance = std::max(largest_irradiance, luminance(truth));
  }
  errors.sh_mean = sum / static_cast<double>(directions.size()) / largest_irradiance;
  errors.sh_max = largest / largest_irradiance;
  errors.directions += static_cast<int>(directions.size());
}

// Scale and bias another way than the table was made: the mean over a regular grid of visible normals (Heitz 2018) of
// G2/G1 times (1 - F, F) with F = (1 - v.h)^5. u1 = 1 - s^3 crowds the grid where normals lean far over and lights fall
// below the horizon, a jump that costs a grid of n^2 points at most about n^-3/2; good to 3e-5.
DfgValue sample_dfg(double cos_view, double alpha) {
  constexpr int side = 500;
  const LocalVec view{std::sqrt((1 - cos_view) * (1 + cos_view)), 0, cos_view};
  DfgValue sum;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const double s = (i + 0.5) / side;
      const LocalVec half = sample_ggx_visible_normal(view, alpha, 1 - s * s * s, (j + 0.5) / side);
      const double cos_light = reflected(view, half).z;
      const double weight = 3 * s * s * ggx_masking_shadowing(cos_view, cos_light, alpha) /
                            ggx_masking(cos_view, alpha) / (static_cast<double>(side) * side);
      const double fresnel = fresnel_schlick(dot(view, half), 0);
      sum.scale += weight * (1 - fresnel);
      sum.bias += weight * fresnel;
    }
  return sum;
}

// The stored form's two numbers: for the compensated form, the line through the reflectance
// at F0 = 0.04 and F0 = 1.
DfgValue exact_dfg(double cos_view, double alpha, DfgForm form) {
  const DfgValue single = sample_dfg(cos_view, alpha);
  if (form == DfgForm::scale_bias) return single;
  const auto reflectance = [&](double f0) {
    return (f0 * single.scale + single.bias) * multiple_scattering_factor(f0, single.albedo());
  };
  const double scale = (reflectance(1) - reflectance(0.04)) / 0.96;
  return {scale, reflectance(1) - scale};
}

double verify_dfg(const DfgTable& table, DfgForm form) {
  constexpr int points = 8;
  const auto partials =
      parallel_partials<double>(points * points, 1, [&](double& largest, std::size_t k, std::size_t) {
        const int x = (2 * static_cast<int>(k % points) + 1) * table.size / (2 * points);
        const int y = (2 * static_cast<int>(k / points) + 1) * table.size / (2 * points);
        const double r = (y + 0.5) / table.size;
        const DfgValue exact = exact_dfg((x + 0.5) / table.size, r * r, form);
        const float* texel = &table.scale_bias[(static_cast<std::size_t>(y) * table.size + x) * 2];
        largest = std::max(std::abs(static_cast<double>(texel[0]) - exact.scale),
                           std::abs(static_cast<double>(texel[1]) - exact.bias));
      });
  return *std::max_element(partials.begin(), partials.end());
}

}  // namespace

IblErrors verify_ibl(const IblSet& set, const Image& radiance, const IblOptions& options,
                     const VerifyOptions& verify) {
  const auto start = std::chrono::steady_clock::now();
  const auto progress = [&](std::size_t done) {
    if (verify.progress)
      verify.progress(static_cast<double>(done) / static_cast<double>(set.specular.levels.size() + 2));
  };
  IblErrors errors;
  errors.levels.push_back(verify_environment(radiance, set.specular.levels.front()));
  for (std::size_t k = 1; k < set.specular.levels.size(); ++k) {
    errors.levels.push_back(verify_cube(radiance, set.specular.levels[k], set.levels[k].kernel, 1, verify));
    errors.directions += 5 * verify.directions / 2;
    progress(k);
  }
  errors.irradiance = verify_cube(radiance, set.irradiance, make_lambert_kernel(), pi, verify);
  verify_trilinear(set, radiance, options, verify, errors);
  verify_nine_coefficients(radiance, verify, errors);
  errors.dfg_max = verify_dfg(set.dfg, options.dfg_form);
  errors.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return errors;
}

}  // namespace welkin
