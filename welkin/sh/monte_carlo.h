#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sphere/mapping.h>

namespace welkin {

enum class SampleKind {
  uniform_random,  ///< independent directions, uniform over the sphere: error like 1/sqrt(samples)
  low_discrepancy  ///< independently shifted R2 sequences (sampling/sequence.h), mapped to the sphere by its areas
};

struct MonteCarloOptions {
  /// 2 or more. low_discrepancy takes the next multiple of low_discrepancy_runs.
  std::uint64_t samples = 65536;
  /// Equal seeds give equal results.
  std::uint64_t seed = 1;
  SampleKind kind = SampleKind::uniform_random;
};

/// low_discrepancy averages this many independent runs: their spread is what tells the error, which a single
/// low-discrepancy sequence cannot.
inline constexpr int low_discrepancy_runs = 16;

/// A projection by sampling: coefficients as project_equirect gives them, and beside each value its standard error
/// (same layout): the estimate's standard deviation, from the samples' own variance. Light that no sample met, a small sun
/// among few samples, is missing from both.
struct MonteCarloProjection {
  ShCoefficients coefficients;
  std::vector<double> standard_errors;
  std::uint64_t samples = 0;
};

/// Radiance from a unit direction, one value per channel; called from several threads at once.
using RadianceFunction = std::function<void(Vec3 direction, std::span<double> radiance)>;

/// The integral of L Y_lm as 4 pi times the mean of L Y_lm over uniform directions (Green 2003, "Spherical Harmonic
/// Lighting: The Gritty Details"; King 2005, section 10.3). The same bytes on any number of threads. Throws Error when
/// channels < 1, samples < 2 or max_degree is negative or above max_projection_degree.
MonteCarloProjection project_monte_carlo(const RadianceFunction& radiance, int channels, int max_degree,
                                         const MonteCarloOptions& options = {});

/// The same for a map whose texels are patches of constant radiance.
MonteCarloProjection project_monte_carlo(const SphereMap& radiance, int max_degree,
                                         const MonteCarloOptions& options = {});

}  // namespace welkin
