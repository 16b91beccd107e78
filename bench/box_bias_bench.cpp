#include <algorithm>
#include <cmath>
#include <random>

#include "measure.h"

#include <welkin/envmap/environment.h>
#include <welkin/envmap/filter.h>
#include <welkin/envmap/methods/box.h>
#include <welkin/envmap/methods/working_cube.h>
#include <welkin/error.h>

// The level bias of a hardware mip chain that is nearest to a kernel, fitted, beside the law box_level_bias. The
// error of a line is the distance of the law from the fit in levels; on real maps with few lamps the optimum is flat.
// Usage: bench_box_bias [FILE ...]

namespace {

using namespace welkin;

constexpr int target_size = 24;

Image noise_map(int width, unsigned seed) {
  Image map(width, width / 2);
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  for (int i = 0; i < width * width / 2; ++i) {
    const float value = std::exp(0.7f * normal(random));
    for (int c = 0; c < 3; ++c) map.pixels[3 * i + c] = value;
  }
  return map;
}

double relative_rms(const Cube& cube, const Cube& truth) {
  double squared = 0, reference = 0;
  for (std::size_t i = 0; i < truth.texels.size(); ++i) {
    const double t = static_cast<double>(truth.texels[i]), error = static_cast<double>(cube.texels[i]) - t;
    squared += error * error;
    reference += t * t;
  }
  return std::sqrt(squared / reference);
}

struct Fit {
  double bias = 0, error = 1e9;
};

// The best of all biases in steps of 1/20.
Fit fit_bias(const CubeMips& chain, const FilterTarget& target, const Cube& truth) {
  Fit best;
  const int last = 20 * (static_cast<int>(chain.levels.size()) - 1);
  for (int i = 0; i <= last; ++i) {
    const double error = relative_rms(look_up_box_chain(chain, target, i / 20.0), truth);
    if (error < best.error) best = {i / 20.0, error};
  }
  return best;
}

void fit_map(bench::Report& report, const std::string& name, const Image& map, int size, double limit) {
  report.note(fmt::format("-- {} ({} x {}), chain of a cube of {}", name, map.width, map.height, size));
  const CubeMips chain = box_chain(working_cube(map, size));
  std::vector<FilterTarget> targets;
  for (double exponent : {20.0, 60.0, 225.0, 600.0, 2000.0})
    targets.push_back({make_phong_kernel(exponent), target_size});
  for (double alpha : {0.03, 0.0625, 0.125, 0.25}) targets.push_back({make_ggx_kernel(alpha), target_size});
  const std::vector<Cube> truths = filter_environment(map, targets);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double law = box_level_bias(targets[i].kernel, size);
    if (law < 1) continue;  // narrower than two texels
    const Fit fit = fit_bias(chain, targets[i], truths[i]);
    const double at_law = relative_rms(look_up_box_chain(chain, targets[i], law), truths[i]);
    const double constant = fit.bias - std::log2(size * kernel_spread(targets[i].kernel));
    report.check(fmt::format("{}: fit {:.2f}, law {:.2f}", describe(targets[i].kernel), fit.bias, law),
                 std::abs(fit.bias - law), limit);
    report.note(fmt::format("    constant {:.2f}; relative RMS {:.3f} at the fit, {:.3f} at the law",
                            constant, fit.error, at_law));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  for (int size : {32, 64, 128}) fit_map(report, "log-normal noise", noise_map(4 * size, 1), size, 0.7);
  for (int i = 1; i < argc; ++i)
    for (int size : {64, 256}) fit_map(report, argv[i], load_environment(argv[i]).radiance, size, 2);
  return report.exit_code();
} catch (const Error& error) {
  fmt::print(stderr, "bench_box_bias: {}\n", error.what());
  return 1;
}
