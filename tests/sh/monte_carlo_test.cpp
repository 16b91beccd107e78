#include <welkin/sh/monte_carlo.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "test_maps.h"

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/map_projection.h>
#include <welkin/sphere/labelled_map.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// L = exp(x): its integral over the sphere is 4 pi sinh 1, that of x exp(x) is 4 pi (cosh 1 - sinh 1) = 4 pi / e, and
// y and z times it vanish.
void exponential(Vec3 direction, std::span<double> out) { out[0] = std::exp(direction.x); }

const double truth_00 = std::sqrt(1 / (4 * pi)) * 4 * pi * std::sinh(1.0);
const double truth_11 = std::sqrt(3 / (4 * pi)) * 4 * pi * std::exp(-1.0);

double rms_error(SampleKind kind, std::uint64_t samples) {
  double sum = 0;
  constexpr int seeds = 24;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const std::vector<double> values =
        project_monte_carlo(exponential, 1, 1, {samples, seed, kind}).coefficients.values;
    for (std::size_t i = 0; i < 4; ++i) {
      const double truth = i == 0 ? truth_00 : i == sh_index(1, 1) ? truth_11 : 0;
      sum += (values[i] - truth) * (values[i] - truth);
    }
  }
  return std::sqrt(sum / (4 * seeds));
}

// 64 times the samples: 1/8 of the error. An RMS over 24 seeds is itself uncertain by about a tenth.
TEST(MonteCarlo, RandomErrorFallsWithTheSquareRoot) {
  const double ratio =
      rms_error(SampleKind::uniform_random, 256) / rms_error(SampleKind::uniform_random, 16384);
  EXPECT_NEAR(ratio, 8, 2.4);
}

TEST(MonteCarlo, LowDiscrepancyErrorFallsFaster) {
  const double ratio =
      rms_error(SampleKind::low_discrepancy, 256) / rms_error(SampleKind::low_discrepancy, 16384);
  EXPECT_GT(ratio, 20);
  EXPECT_LT(rms_error(SampleKind::low_discrepancy, 16384),
            0.1 * rms_error(SampleKind::uniform_random, 16384));
}

// For random samples the z-scores of many seeds have mean square 1, +- sqrt(2/200) of chance and correlation; those
// of the 16 runs follow Student's t with 15 degrees of freedom, mean square 15/13.
TEST(MonteCarlo, StandardErrorsAreHonest) {
  for (SampleKind kind : {SampleKind::uniform_random, SampleKind::low_discrepancy}) {
    double squares = 0, largest = 0;
    constexpr int seeds = 100;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const MonteCarloProjection p = project_monte_carlo(exponential, 1, 1, {2048, seed, kind});
      for (std::size_t i : {sh_index(0, 0), sh_index(1, 1)}) {
        const double z = (p.coefficients.values[i] - (i == 0 ? truth_00 : truth_11)) / p.standard_errors[i];
        squares += z * z / (2 * seeds);
        largest = std::max(largest, std::abs(z));
      }
    }
    EXPECT_NEAR(squares, 1.08, 0.4);
    EXPECT_LT(largest, 5);
  }
}

// Texels are looked up in the same patches that the exact ways integrate.
TEST(MonteCarlo, OfMapsAgreesWithTheExactProjection) {
  for (Mapping mapping : {Mapping::equirectangular, Mapping::cube, Mapping::dual_paraboloid}) {
    const SphereMap map = labelled_map(map_shape(mapping, 16));
    const ShCoefficients exact = project_map(map, 2);
    for (SampleKind kind : {SampleKind::uniform_random, SampleKind::low_discrepancy}) {
      const MonteCarloProjection p = project_monte_carlo(map, 2, {40000, 3, kind});
      for (std::size_t i = 0; i < exact.values.size(); ++i) {
        EXPECT_LT(std::abs(p.coefficients.values[i] - exact.values[i]), 5 * p.standard_errors[i]) << i;
        EXPECT_LT(p.standard_errors[i], 0.05);  // 4 pi times 0.3, over 200, is 0.02
      }
    }
  }
}

TEST(MonteCarlo, DoesNotDependOnThreads) {
  const SphereMap map = labelled_map(map_shape(Mapping::cube, 8));
  set_thread_count(1);
  const MonteCarloProjection one = project_monte_carlo(map, 3);
  set_thread_count(3);
  const MonteCarloProjection three = project_monte_carlo(map, 3);
  set_thread_count(0);
  EXPECT_EQ(one.coefficients.values, three.coefficients.values);
  EXPECT_EQ(one.standard_errors, three.standard_errors);
}

TEST(MonteCarlo, CountsItsSamplesAndRefusesTooFew) {
  EXPECT_EQ(project_monte_carlo(exponential, 1, 0, {100, 1, SampleKind::uniform_random}).samples, 100u);
  EXPECT_EQ(project_monte_carlo(exponential, 1, 0, {100, 1, SampleKind::low_discrepancy}).samples, 112u);
  EXPECT_THROW(project_monte_carlo(exponential, 1, 0, {1, 1, SampleKind::uniform_random}), Error);
  EXPECT_THROW(project_monte_carlo(exponential, 0, 0), Error);
  EXPECT_THROW(project_monte_carlo(exponential, 1, -1), Error);
}

}  // namespace
}  // namespace welkin
