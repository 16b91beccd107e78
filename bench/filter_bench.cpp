#include <algorithm>
#include <ctime>
#include <random>

#include "measure.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/ibl.h>
#include <welkin/envmap/level_law.h>
#include <welkin/envmap/statistics.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

// The filtered levels of a set (ggx, size 256, 9 levels): time and error of each, and what brute force would take for
// the same texels, extrapolated from those that it was asked for. Usage: bench_filter [FILE ...]

namespace {

using namespace welkin;

constexpr int levels = 9, size = 256, runs = 3;

std::vector<FilterTarget> ggx_targets() {
  std::vector<FilterTarget> targets;
  for (int k = 1; k < levels; ++k) {
    const double r = level_to_perceptual_roughness(LevelLaw::linear, k, levels, size);
    targets.push_back({make_ggx_kernel(r * r), size >> k});
  }
  return targets;
}

struct Errors {
  double relative_rms = 0, max_over_mean = 0;
  double brute_seconds = 0;  // for the whole level
};

struct Texel {
  int face, x, y;
};

// `count` texels at random, or all if there are fewer, and the brightest of all as the last one.
std::vector<Texel> choose_texels(const Cube& cube, int count) {
  const int n = cube.size, texels = 6 * n * n;
  const auto texel = [n](int i) { return Texel{i / (n * n), i % n, i / n % n}; };
  std::mt19937 random(1);
  std::vector<Texel> chosen;
  for (int i = 0; i < std::min(count, texels); ++i)
    chosen.push_back(texel(count < texels ? static_cast<int>(random() % static_cast<unsigned>(texels)) : i));
  const auto brightest = std::max_element(cube.texels.begin(), cube.texels.end()) - cube.texels.begin();
  chosen.push_back(texel(static_cast<int>(brightest / 3)));
  return chosen;
}

Errors compare_with_brute_force(const Image& map, const Cube& cube, const ZonalKernel& kernel, int count,
                                double mean) {
  const std::vector<Texel> texels = choose_texels(cube, count);
  std::vector<Vec3> directions;
  for (const Texel& t : texels) directions.push_back(cube_texel_direction(cube.size, t.face, t.x, t.y));
  std::vector<double> truth;
  const double seconds =
      bench::seconds_of([&] { truth = filter_brute_force(map, directions, std::span(&kernel, 1)); });
  Errors errors;
  double error_sum = 0, truth_sum = 0;
  for (std::size_t i = 0; i < texels.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double t = truth[3 * i + c], e = cube.at(texels[i].face, texels[i].x, texels[i].y)[c] - t;
      errors.max_over_mean = std::max(errors.max_over_mean, std::abs(e) / mean);
      if (i + 1 == texels.size()) continue;  // the brightest would rule the mean
      error_sum += e * e;
      truth_sum += t * t;
    }
  errors.relative_rms = std::sqrt(error_sum / truth_sum);
  errors.brute_seconds = seconds / static_cast<double>(texels.size()) * 6 * cube.size * cube.size;
  return errors;
}

double mean_luminance(const Image& map) {
  const auto mean = map_statistics(map).mean_radiance;
  return 0.2126 * mean[0] + 0.7152 * mean[1] + 0.0722 * mean[2];
}

std::vector<std::vector<double>> level_seconds(const Image& map, const std::vector<FilterTarget>& targets,
                                               std::vector<double>& analysis, std::vector<double>& total) {
  std::vector<std::vector<double>> seconds(targets.size());
  for (int run = 0; run < runs; ++run) {
    FilterReport report;
    total.push_back(bench::seconds_of([&] { filter_environment(map, targets, {}, &report); }));
    analysis.push_back(report.analysis_seconds);
    for (std::size_t i = 0; i < targets.size(); ++i) seconds[i].push_back(report.levels[i].seconds);
  }
  return seconds;
}

void bench_map(bench::Report& report, const std::string& source, int texels_a_level) {
  const Image map = load_environment(source).radiance;
  const std::vector<FilterTarget> targets = ggx_targets();
  report.note(fmt::format("-- {} ({} x {}), ggx, size {}, {} levels, {} threads", source, map.width,
                          map.height, size, levels, thread_count()));
  const std::vector<Cube> cubes = filter_environment(map, targets);  // validated below, and warms up
  const double mean = mean_luminance(map);
  std::vector<Errors> errors;
  for (std::size_t i = 0; i < targets.size(); ++i)
    errors.push_back(compare_with_brute_force(map, cubes[i], targets[i].kernel, texels_a_level, mean));
  std::vector<double> analysis, total;
  const auto seconds = level_seconds(map, targets, analysis, total);
  double brute = 0, worst_rms = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const bench::Timing time = bench::timing_of(seconds[i]);
    brute += errors[i].brute_seconds;
    worst_rms = std::max(worst_rms, errors[i].relative_rms);
    report.figure(
        fmt::format("level {} ({}, alpha {:.4f})", i + 1, targets[i].size, targets[i].kernel.parameter), time,
        errors[i].relative_rms, 1e-4,
        fmt::format("max/mean {:.1e}; brute force {:.4g} s, {:.0f} times", errors[i].max_over_mean,
                    errors[i].brute_seconds, errors[i].brute_seconds / time.best));
    if (errors[i].max_over_mean > 1e-3)
      report.check("  largest error over the mean", errors[i].max_over_mean, 1e-3);
  }
  report.note(fmt::format("{:<40} {:>6.0f} ms best", "analysis, shared by all levels",
                          1000 * bench::timing_of(analysis).best));
  const bench::Timing all = bench::timing_of(total);
  report.figure("all levels", all, worst_rms, 1e-4,
                fmt::format("brute force {:.4g} s, {:.0f} times", brute, brute / all.best));
}

// What `welkin ibl` computes from a map, without files: the environment cube and all filtered levels with irradiance.
// Processor seconds of all threads together, which other programs on the machine do not add to, stand beside.
void bench_set(bench::Report& report, const std::string& source) {
  const Image map = load_environment(source).radiance;
  IblOptions options;
  options.size = size;
  const auto processor = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  std::vector<double> seconds;
  IblSet set;
  const bench::Timing wall = bench::measure(runs, [&] {
    const double start = processor();
    set = make_ibl(map, options);
    seconds.push_back(processor() - start);
  });
  report.note(
      fmt::format("-- {}: the set of {} (make_ibl, irradiance, coefficients and DFG included): {:.0f} ms "
                  "best, processor {:.0f} ms; "
                  "cube and its mips {:.0f} ms, analysis {:.0f} ms",
                  source, size, 1000 * wall.best, 1000 * bench::timing_of(seconds).best,
                  1000 * set.seconds_environment, 1000 * set.filter.analysis_seconds));
}

void bench_threads(bench::Report& report) {
  const Image map = load_environment("sky:day,size=1024x512").radiance;
  const std::vector<FilterTarget> targets = ggx_targets();
  report.note("-- sky:day, threads; the error is the number of texels that differ");
  std::vector<Cube> one;
  double single = 0;
  for (int threads : {1, 2}) {
    set_thread_count(threads);
    std::vector<Cube> cubes;
    const bench::Timing time = bench::measure(runs, [&] { cubes = filter_environment(map, targets); });
    if (threads == 1) one = cubes, single = time.best;
    double different = 0;
    for (std::size_t i = 0; i < cubes.size(); ++i) different += cubes[i].texels != one[i].texels;
    report.figure(fmt::format("{} thread{}", threads, threads > 1 ? "s" : ""), time, different, 0,
                  fmt::format("{:.2f} times one thread", single / time.best));
  }
  set_thread_count(0);
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  for (const char* sky : {"sky:day,size=1024x512", "sky:studio,size=1024x512"}) bench_map(report, sky, 48);
  for (int i = 1; i < argc; ++i) bench_map(report, argv[i], 48);
  bench_map(report, "sky:day,size=4096x2048", 12);
  for (const char* sky : {"sky:day,size=1024x512", "sky:day,size=4096x2048"}) bench_set(report, sky);
  bench_threads(report);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_filter: {}\n", error.what());
  return 1;
}
