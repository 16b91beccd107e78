#pragma once
#include <vector>

#include <welkin/envmap/bright_texels.h>
#include <welkin/envmap/filter.h>
#include <welkin/sh/spectrum.h>

// How filter_environment does each target: private to welkin/envmap.

namespace welkin {

/// What a target's kernel does to each degree, up to the degree that its error bound needs.
struct KernelPlan {
  std::vector<double> factors;  ///< k_l times the target's scale
  double near_angle = 0;        ///< rad; > 0: factors are those of the kernel without its core
  bool bound_met =
      true;  ///< false: no degree within reach met the error bound; factors go as far as they can
};

/// The degree beyond which a kernel's spectrum can be dropped for a map with this much light above its mean, and the
/// choice between the whole kernel and a core summed directly, by predicted cost.
KernelPlan plan_kernel(const FilterTarget& target, const BrightSplit& map, double tolerance);

/// The degree and the grid that one target's spectrum needs, from the power that the map really has in each degree.
struct SynthesisPlan {
  int degree = 0;
  int grid_rows = 0;
};
SynthesisPlan plan_synthesis(const std::vector<double>& factors, const std::vector<double>& degree_power,
                             double largest_error);

}  // namespace welkin
