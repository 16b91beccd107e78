#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <welkin/envmap/zonal_kernel.h>
#include <welkin/image/image.h>

namespace welkin {

/// One filtered cube that is wanted: texel = scale * integral of K(angle to texel centre) * radiance.
struct FilterTarget {
  ZonalKernel kernel;
  int size = 0;      ///< texels along an edge
  double scale = 1;  ///< pi for irradiance with the lambert kernel
};

struct FilterOptions {
  /// The largest error aimed at anywhere, relative to the map's mean luminance, 1e-6 to 0.1; the relative RMS error is
  /// far below. An estimate decides (docs/methods.md): measured errors stay within a few times it.
  double tolerance = 3e-4;
  /// Told the share of the work done so far, in [0, 1], now and then, from the calling thread.
  std::function<void(double)> progress;
};

struct FilterLevelReport {
  int degree = 0;     ///< of the spectrum that was synthesised; -1 where there was none
  int grid_rows = 0;  ///< of the grid that the faces were interpolated from
  double near_angle =
      0;  ///< rad; where the kernel was too narrow for the transform, its core was summed directly
  double seconds = 0;
  bool bound_met =
      true;  ///< false: the error bound asked for more than the transform can give; expect errors
};

struct FilterReport {
  int degree = 0;         ///< of the analysis
  int bright_texels = 0;  ///< summed directly
  double analysis_seconds = 0;
  std::vector<FilterLevelReport> levels;
};

/// Filters an environment by all targets at once, in frequency space: the map's brightest texels are taken out and
/// summed directly, the rest is transformed to spherical harmonics once, and each target multiplies the spectrum by
/// its kernel's Legendre coefficients (Funk-Hecke), keeps as many degrees and as fine a grid as its error bound asks
/// for, and interpolates its texels. Where a kernel is so narrow that its spectrum would cost more, only the smooth
/// outer part of it goes that way and the core is summed over the texels that it covers.
/// radiance: equirectangular, 3 channels, finite and >= 0. Throws Error for a tolerance out of range. Same bits on any number of threads.
/// Measured against filter_brute_force; see docs/methods.md.
std::vector<Cube> filter_environment(const Image& radiance, std::span<const FilterTarget> targets,
                                     const FilterOptions& options = {}, FilterReport* report = nullptr);

}  // namespace welkin
