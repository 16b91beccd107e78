#include <welkin/envmap/methods/filter_method.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "../maps.h"

#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/methods/filter_truth.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

const std::vector<FilterTarget>& targets() {
  static const std::vector<FilterTarget> all{
      {make_ggx_kernel(0.25), 8, 1}, {make_phong_kernel(100), 8, 1}, {make_lambert_kernel(), 8, 3.0}};
  return all;
}

// Every texel by brute force, in double.
std::vector<double> truth_of(const Image& map, const FilterTarget& target) {
  const int n = target.size;
  std::vector<Vec3> directions;
  for (int i = 0; i < 6 * n * n; ++i)
    directions.push_back(cube_texel_direction(n, i / (n * n), i % n, i / n % n));
  std::vector<double> values = filter_brute_force(map, directions, std::span(&target.kernel, 1));
  for (double& value : values) value *= target.scale;
  return values;
}

double relative_rms(const Cube& cube, const std::vector<double>& truth) {
  double squared = 0, reference = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = static_cast<double>(cube.texels[i]) - truth[i];
    squared += error * error;
    reference += truth[i] * truth[i];
  }
  return std::sqrt(squared / reference);
}

// Random maps with the truth of every target, made once for all tests.
struct Case {
  Image map;
  std::vector<std::vector<double>> truths;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> made;
    for (unsigned seed : {1u, 2u}) {
      Case next{lamp_map(64, 32, seed), {}};
      for (const FilterTarget& target : targets()) next.truths.push_back(truth_of(next.map, target));
      made.push_back(std::move(next));
    }
    return made;
  }();
  return all;
}

// The largest relative RMS of a method over maps and kernels.
double worst_rms(FilterMethod method) {
  double worst = 0;
  for (const Case& at : cases())
    for (std::size_t i = 0; i < targets().size(); ++i)
      worst = std::max(worst, relative_rms(filter_by_method(at.map, targets()[i], method), at.truths[i]));
  return worst;
}

// Both ways are the same function; what is left is the rounding to float.
TEST(FilterMethod, BruteIsTheOracle) {
  const FilterTarget small{make_ggx_kernel(0.1), 2, 2};
  const Cube cube = filter_by_method(cases()[0].map, small, FilterMethod::brute);
  EXPECT_LT(relative_rms(cube, truth_of(cases()[0].map, small)), 1e-7);
}

TEST(FilterMethod, FrequencyIsExact) { EXPECT_LT(worst_rms(FilterMethod::frequency), 1e-4); }

// What docs/filters.md states for the defaults on maps of this kind, 64 x 32 texels with lamps of 2 x 2: twice of what was
// measured over four seeds, 0.05, 0.09 and 0.18. The last two are those of phong 100, whose lobe is hardly wider than the texels of the
// cube of 16 that such a map makes.
TEST(FilterMethod, HierarchicalKeepsItsError) { EXPECT_LT(worst_rms(FilterMethod::hierarchical), 0.1); }
TEST(FilterMethod, AngularKeepsItsError) { EXPECT_LT(worst_rms(FilterMethod::angular), 0.2); }
TEST(FilterMethod, ImportanceKeepsItsError) { EXPECT_LT(worst_rms(FilterMethod::importance), 0.4); }

// More nodes and more samples are nearer to the truth. ggx and phong: the texels' own width over the kernel's, squared, and
// 1/16 squared for the rest. Lambert ends with a kink at 90 degrees, and a node of 2 x 2 texels that lies across it is
// still taken whole at this detail: a lamp of 2 x 2 there is off by up to a quarter of a node's half size (0.098) times the
// kink. Measured 0.0087 (0.0062 and 0.0064 with other seeds); with the nodes across the kink split it is 0.0012.
TEST(FilterMethod, HierarchicalConvergesWithDetail) {
  FilterMethodOptions options;
  options.hierarchical.detail = 16;
  const double limits[] = {5e-3, 5e-3, 0.012};
  for (std::size_t i = 0; i < targets().size(); ++i) {
    const Cube cube = filter_by_method(cases()[0].map, targets()[i], FilterMethod::hierarchical, options);
    EXPECT_LT(relative_rms(cube, cases()[0].truths[i]), limits[i]) << describe(targets()[i].kernel);
  }
}

TEST(FilterMethod, ImportanceConvergesWithSamples) {
  FilterMethodOptions options;
  const Case& at = cases()[0];
  double before = 1;
  for (int samples : {4, 64, 1024}) {
    options.importance.samples = samples;
    const double error =
        relative_rms(filter_by_method(at.map, targets()[0], FilterMethod::importance, options), at.truths[0]);
    EXPECT_LT(error, before) << samples;
    before = error / 1.5;
  }
}

TEST(FilterMethod, ScrambledSamplesDependOnTheSeedAlone) {
  FilterMethodOptions options;
  options.importance.scramble = true;
  const auto cube = [&](std::uint32_t seed) {
    options.importance.seed = seed;
    return filter_by_method(cases()[0].map, targets()[1], FilterMethod::importance, options);
  };
  EXPECT_EQ(cube(1).texels, cube(1).texels);
  EXPECT_NE(cube(1).texels, cube(2).texels);
}

TEST(FilterTruth, MeasuresWhatIsThere) {
  const Case& at = cases()[1];
  const FilterTruth truth = make_filter_truth(at.map, targets()[2], 20);
  ASSERT_EQ(truth.texels.size(), 30u);
  Cube cube = filter_by_method(at.map, targets()[2], FilterMethod::frequency);
  EXPECT_LT(compare_with_truth(cube, truth).relative_rms, 1e-4);  // as FrequencyIsExact
  for (float& value : cube.texels) value *= 1.1f;
  EXPECT_NEAR(compare_with_truth(cube, truth).relative_rms, 0.1, 1e-3);
  EXPECT_GT(compare_with_truth(cube, truth).max_over_mean, 0.1);  // 10 % of something above the mean
}

TEST(FilterMethod, NamesAreReadAsTheyAreWritten) {
  for (FilterMethod method : filter_methods())
    EXPECT_EQ(parse_filter_method(filter_method_name(method)), method);
  EXPECT_THROW(parse_filter_method("fast"), Error);
  EXPECT_TRUE(std::is_sorted(filter_methods().begin(), filter_methods().end()));
}

// The weights of every method add up to one.
TEST(FilterMethod, LeavesAConstantAsItIs) {
  const Image map = constant_map(32, 16, 5);
  for (FilterMethod method : filter_methods())
    for (const ZonalKernel& kernel : {make_ggx_kernel(0.3), make_lambert_kernel()})
      for (float value : filter_by_method(map, {kernel, 4, 3}, method).texels)
        ASSERT_NEAR(value, 15, 3e-3) << filter_method_name(method) << ", " << describe(kernel);
}

TEST(FilterMethod, IsBitIdenticalOnAnyNumberOfThreads) {
  const Image map = lamp_map(32, 16, 3);
  const FilterTarget target{make_ggx_kernel(0.2), 4, 1};
  for (FilterMethod method : filter_methods()) {
    set_thread_count(1);
    const Cube once = filter_by_method(map, target, method);
    set_thread_count(3);
    EXPECT_EQ(filter_by_method(map, target, method).texels, once.texels) << filter_method_name(method);
  }
  set_thread_count(0);
}

TEST(FilterMethod, RefusesSizesOutOfReach) {
  const Image map = constant_map(8, 4, 1);
  for (int size : {0, -3, 100000})
    EXPECT_THROW(filter_by_method(map, {make_lambert_kernel(), size, 1}), Error) << size;
}

}  // namespace
}  // namespace welkin
