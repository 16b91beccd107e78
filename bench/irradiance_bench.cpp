#include <algorithm>
#include <numbers>
#include <vector>

#include "measure.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/ibl.h>
#include <welkin/error.h>
#include <welkin/sh/projection.h>
#include <welkin/sphere/cube.h>

// An irradiance map of 6 x 64 x 64 three ways. Errors are luminance, against the exact sum over all texels, over the
// largest irradiance (as Ramamoorthi & Hanrahan 2001 state theirs).

namespace {

using namespace welkin;

constexpr double pi = std::numbers::pi;
constexpr int size = 64;

template <class T>
double luminance(const T* rgb) {
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Every 61st texel: 403 of them, in no step with rows of 64.
struct Truth {
  std::vector<int> texels;
  std::vector<double> irradiance;  // luminance
  double largest = 0;
};

Truth make_truth(const Image& map) {
  Truth truth;
  std::vector<Vec3> directions;
  for (int i = 0; i < 6 * size * size; i += 61) {
    truth.texels.push_back(i);
    directions.push_back(cube_texel_direction(size, i / (size * size), i % size, i / size % size));
  }
  const ZonalKernel lambert = make_lambert_kernel();
  const std::vector<double> values = filter_brute_force(map, directions, std::span(&lambert, 1));
  for (std::size_t i = 0; i < directions.size(); ++i)
    truth.irradiance.push_back(pi * luminance(&values[3 * i]));
  truth.largest = *std::max_element(truth.irradiance.begin(), truth.irradiance.end());
  return truth;
}

struct Errors {
  double mean = 0, largest = 0;
};

Errors errors_of(const Cube& cube, const Truth& truth) {
  Errors errors;
  for (std::size_t i = 0; i < truth.texels.size(); ++i) {
    const double e =
        std::abs(luminance(&cube.texels[std::size_t{3} * truth.texels[i]]) - truth.irradiance[i]) /
        truth.largest;
    errors.mean += e / static_cast<double>(truth.texels.size());
    errors.largest = std::max(errors.largest, e);
  }
  return errors;
}

void figure(bench::Report& report, const std::string& what, bench::Timing time, const Errors& errors,
            double limit, const std::string& yardstick) {
  report.figure(what, time, errors.mean, limit,
                fmt::format("mean, {:.1e} largest; {}", errors.largest, yardstick));
}

void bench_map(bench::Report& report, const std::string& source) {
  const Image map = load_environment(source).radiance;
  report.note(fmt::format("-- {} ({} x {}), irradiance map of 6 x {} x {}", source, map.width, map.height,
                          size, size));
  const Truth truth = make_truth(map);
  // Brute force is timed on a cube of 8, whose texels cost as much each, and multiplied up.
  constexpr int small = 8;
  bench::Timing brute = bench::measure(2, [&] { irradiance_brute_force(map, small); });
  brute.best *= size * size / (small * small);
  brute.median *= size * size / (small * small);

  Cube cube;
  const FilterTarget target{make_lambert_kernel(), size, pi};
  const bench::Timing frequency =
      bench::measure(5, [&] { cube = filter_environment(map, std::span(&target, 1)).front(); });
  figure(report, "frequency", frequency, errors_of(cube, truth), 1e-4,
         fmt::format("{:.0f} times brute force", brute.best / frequency.best));
  const bench::Timing nine =
      bench::measure(5, [&] { cube = irradiance_from_sh(project_equirect(map, 2), size); });
  figure(report, "nine coefficients", nine, errors_of(cube, truth), 0.05,
         fmt::format("{:.0f} times brute force", brute.best / nine.best));
  const bench::Timing centres =
      bench::measure(5, [&] { cube = irradiance_from_sh(project_equirect_texel_centres(map, 2), size); });
  figure(report, "nine coefficients, texel centres", centres, errors_of(cube, truth), 0.05,
         fmt::format("{:.0f} times brute force", brute.best / centres.best));
  figure(report, "brute force (extrapolated from 8 x 8)", brute, {}, 0, "by definition");
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  for (const char* sky : {"sky:day,size=1024x512", "sky:day,sun=0,size=1024x512",
                          "sky:overcast,size=1024x512", "sky:studio,size=1024x512"})
    bench_map(report, sky);
  for (int i = 1; i < argc; ++i) bench_map(report, argv[i]);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_irradiance: {}\n", error.what());
  return 1;
}
