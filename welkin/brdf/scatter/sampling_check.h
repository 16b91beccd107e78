#pragma once
#include <cstdint>
#include <vector>

#include <welkin/brdf/scatter/scatter.h>

// Whether a sampler does what its density says, and what a BRDF reflects, by quadrature and by sampling.

namespace welkin {

struct SamplingCheckOptions {
  int samples = 1 << 18;  ///< in [1000, 1e9]
  std::uint32_t seed = 1;
};

struct SamplingCheck {
  Rgb quadrature_albedo;      ///< integral of evaluate; without delta lobes
  Rgb sampled_albedo;         ///< mean weight, with delta lobes
  Rgb standard_error;         ///< of the mean weight
  double relative_std = 0;    ///< of the weight's largest channel over its mean: the noise in a white furnace
  double largest_weight = 0;  ///< of a channel
  double pdf_integral = 0;    ///< over the hemisphere, by quadrature
  double kept = 0;            ///< the share of samples that have a pdf: pdf_integral, when all is well
  double delta = 0;           ///< the share of delta samples
  double pdf_error = 0;       ///< largest |pdf() / sample's pdf - 1|
  std::vector<double> observed, expected;  ///< samples per bin, the last one those that are lost or delta
  double p =
      0;  ///< of Pearson's test on the two, bins below 5 expected pooled (Wilson & Hilferty 1931): 1 when all is delta
};

/// Bins and quadrature share polar coordinates about the lobe's axis, in rings that double in width from a quarter of the
/// lobe's, each cut at the horizon exactly, so that integrands are smooth in every bin. Quadrature is within 1e-4 for view.z >= 0.1, Oren-Nayar's kinks within 1e-3.
/// Needs view.z > 0; random numbers are independent. Throws Error for options out of range.
SamplingCheck check_sampling(const Scatter& scatter, Vec3f view, const SamplingCheckOptions& options = {});

}  // namespace welkin
