#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "measure.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/methods/filter_method.h>
#include <welkin/envmap/methods/filter_truth.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/resample.h>

// Every method of the literature beside brute force: milliseconds, relative RMS, largest error over the mean and step across
// the edges, for four exponents and four alphas, on a sun, an interior and a night. Maps of 256 x 128, cubes of 32.
// Usage: bench_methods [FILE ...], which are resampled to that size.

namespace {

using namespace welkin;

constexpr int width = 256, height = 128, size = 32, truths = 96;

// Stars of log-normal brightness over a faint glow, 40 street lamps about the horizon, a dark ground.
Image night_map() {
  Image map(width, height);
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  const auto pick = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
  const float sky[3] = {0.002f, 0.003f, 0.006f}, ground[3] = {0.004f, 0.003f, 0.002f};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float noise = std::exp(0.5f * normal(random));
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = noise * (2 * y < height ? sky : ground)[c];
    }
  const float lamp[3] = {1.0f, 0.6f, 0.25f};
  for (int i = 0; i < 40; ++i) {
    float* texel = map.at(pick(width), 50 + pick(30));
    const float strength = 20 * std::exp(normal(random));
    for (int c = 0; c < 3; ++c) texel[c] = strength * lamp[c];
  }
  return map;
}

Image load_small(const std::string& file) {
  return resample({Mapping::equirectangular, load_environment(file).radiance},
                  map_shape(Mapping::equirectangular, height))
      .image;
}

// What docs/filters.md states, relative RMS on any of these maps; what has no figure here is only shown.
double stated_rms(FilterMethod method) {
  switch (method) {
    case FilterMethod::frequency: return 1e-4;
    case FilterMethod::angular: return 0.1;
    case FilterMethod::hierarchical: return 0.3;
    case FilterMethod::importance: return 0.5;
    case FilterMethod::bordered: return 2;
    case FilterMethod::box: return 1.5;
    case FilterMethod::paraboloid: return 0.6;
    case FilterMethod::quick: return 0.3;
    default: return 1;
  }
}

struct Sums {
  double log_rms = 0, log_milliseconds = 0, largest = 0;
  int count = 0;
};

using Table = std::map<FilterMethod, Sums>;

// Once where that takes long.
bench::Timing time_of(const Image& map, const FilterTarget& target, FilterMethod method, Cube& cube) {
  const auto work = [&] { cube = filter_by_method(map, target, method); };
  const double once = bench::seconds_of(work);
  return once > 0.25 ? bench::Timing{once, once} : bench::measure(3, work);
}

void bench_kernel(bench::Report& report, const Image& map, const ZonalKernel& kernel, Table& table) {
  const FilterTarget target{kernel, size, 1};
  const FilterTruth truth = make_filter_truth(map, target, truths);
  const double brute = truth.seconds / static_cast<double>(truth.texels.size()) * 6 * size * size;
  report.note(fmt::format("{}: brute force {:.0f} ms", describe(kernel), 1000 * brute));
  for (FilterMethod method : filter_methods()) {
    if (method == FilterMethod::brute) continue;
    Cube cube;
    const bench::Timing time = time_of(map, target, method, cube);
    const FilterErrors errors = compare_with_truth(cube, truth);
    report.figure("  " + std::string(filter_method_name(method)), time, errors.relative_rms,
                  stated_rms(method),
                  fmt::format("max/mean {:.1e}, edge step {:.3f}, {:.0f} times brute force",
                              errors.max_over_mean, errors.edge_step, brute / time.best));
    Sums& sums = table[method];
    sums.log_rms += std::log(errors.relative_rms);
    sums.log_milliseconds += std::log(1000 * time.best);
    sums.largest = std::max(sums.largest, errors.relative_rms);
    ++sums.count;
  }
}

void bench_map(bench::Report& report, const std::string& name, const Image& map) {
  report.note(fmt::format("-- {}, {} x {}, cube of {}, {} threads", name, map.width, map.height, size,
                          thread_count()));
  Table table;
  for (double exponent : {5.0, 30.0, 225.0, 2000.0})
    bench_kernel(report, map, make_phong_kernel(exponent), table);
  for (double alpha : {0.0625, 0.15, 0.35, 0.7}) bench_kernel(report, map, make_ggx_kernel(alpha), table);
  report.note(fmt::format("-- {}: geometric means over the kernels", name));
  for (const auto& [method, sums] : table)
    report.note(fmt::format("{:<14} {:>9.2f} ms   RMS {:.1e}, at most {:.1e}", filter_method_name(method),
                            std::exp(sums.log_milliseconds / sums.count), std::exp(sums.log_rms / sums.count),
                            sums.largest));
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  bench_map(report, "sun (sky:day)", load_environment("sky:day,size=256x128").radiance);
  bench_map(report, "interior (sky:studio)", load_environment("sky:studio,size=256x128").radiance);
  bench_map(report, "night (generated)", night_map());
  for (int i = 1; i < argc; ++i) bench_map(report, argv[i], load_small(argv[i]));
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_methods: {}\n", error.what());
  return 1;
}
