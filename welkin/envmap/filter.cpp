#include <welkin/envmap/filter.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>

#include <welkin/envmap/bright_texels.h>
#include <welkin/envmap/filter_direct.h>
#include <welkin/envmap/filter_plan.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/transform.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Every texel: the band-limited part from the grid, the bright texels and the kernel's core summed directly.
Cube gather(const FilterTarget& target, const KernelPlan& plan, const SphereGrid& grid,
            const BrightSplit& map) {
  Cube cube(target.size);
  const std::size_t rows = std::size_t{6} * target.size;
  parallel_for(rows, std::max<std::size_t>(1, 64 / target.size), [&](std::size_t begin, std::size_t end) {
    BrightSum bright(map.texels, target.kernel);
    for (std::size_t row = begin; row < end; ++row) {
      const int face = static_cast<int>(row) / target.size, y = static_cast<int>(row) % target.size;
      for (int x = 0; x < target.size; ++x) {
        const Vec3 direction = cube_texel_direction(target.size, face, x, y);
        float smooth[4];
        interpolate(grid, direction, smooth);
        double rgb[3] = {smooth[0], smooth[1], smooth[2]};
        bright.add(direction, target.scale, rgb);
        if (plan.near_angle > 0) add_core(map, target.kernel, plan.near_angle, direction, target.scale, rgb);
        // The exact result is not negative; the error of the band limit may be.
        for (int c = 0; c < 3; ++c) cube.at(face, x, y)[c] = static_cast<float>(std::max(0.0, rgb[c]));
      }
    }
  });
  return cube;
}

// A kernel that no degree within reach follows, as a table with a spike beside the axis, is not held to the tolerance: its
// grid stays below 2 GiB.
constexpr int most_rows_beyond_bound = 8192;

struct Plan {
  BrightSplit map;
  std::vector<KernelPlan> kernels;
};

// Few bright texels are enough for nearly every map. Where so many light up in so small a place that no degree within
// reach can follow them, more are summed directly.
Plan plan_filter(const Image& radiance, std::span<const FilterTarget> targets, double tolerance) {
  Plan plan;
  for (int most : {64, 512, 4096}) {
    BrightOptions bright;
    bright.max_texels = most;
    plan.map = split_bright_texels(radiance, bright);
    plan.kernels.assign(targets.size(), {});
    parallel_for(targets.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        plan.kernels[i] = plan_kernel(targets[i], plan.map, tolerance);
    });
    const bool met = std::all_of(plan.kernels.begin(), plan.kernels.end(),
                                 [](const KernelPlan& k) { return k.bound_met; });
    const bool none_left = plan.map.threshold <= bright.threshold_over_mean * plan.map.mean;
    if (met || none_left) break;
  }
  return plan;
}

}  // namespace

std::vector<Cube> filter_environment(const Image& radiance, std::span<const FilterTarget> targets,
                                     const FilterOptions& options, FilterReport* report) {
  assert(radiance.channels == 3);
  if (!(options.tolerance >= 1e-6 && options.tolerance <= 0.1))
    throw Error("the filter's tolerance must lie in [1e-6, 0.1]");
  const auto progress = [&](double share) {
    if (options.progress) options.progress(share);
  };
  const Stopwatch analysis_time;
  Plan plan = plan_filter(radiance, targets, options.tolerance);
  progress(0.05);
  AnalysisOptions analysis;
  analysis.max_degree = 1;
  for (const KernelPlan& kernel : plan.kernels)
    analysis.max_degree = std::max(analysis.max_degree, static_cast<int>(kernel.factors.size()) - 1);
  for (const BrightTexel& t : plan.map.texels)
    analysis.replaced.push_back({t.x, t.y, {t.rest[0], t.rest[1], t.rest[2], 0}});
  const Spectrum spectrum = analyze(radiance, analysis);
  const std::vector<double> power = degree_power(spectrum);
  FilterReport made{
      analysis.max_degree, static_cast<int>(plan.map.texels.size()), analysis_time.seconds(), {}};
  progress(0.4);

  std::vector<Cube> cubes;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Stopwatch level_time;
    KernelPlan& kernel = plan.kernels[i];
    const double largest_error = options.tolerance / 3 * targets[i].scale * plan.map.mean;
    SynthesisPlan synthesis = plan_synthesis(kernel.factors, power, largest_error);
    if (!kernel.bound_met) synthesis.grid_rows = std::min(synthesis.grid_rows, most_rows_beyond_bound);
    kernel.factors.resize(synthesis.degree + 1);
    const SphereGrid grid =
        synthesize(convolve(spectrum, kernel.factors), synthesis.grid_rows, 2 * synthesis.grid_rows);
    cubes.push_back(gather(targets[i], kernel, grid, plan.map));
    made.levels.push_back(
        {synthesis.degree, synthesis.grid_rows, kernel.near_angle, level_time.seconds(), kernel.bound_met});
    progress(0.4 + 0.6 * static_cast<double>(i + 1) / static_cast<double>(targets.size()));
  }
  if (report) *report = std::move(made);
  return cubes;
}

}  // namespace welkin
