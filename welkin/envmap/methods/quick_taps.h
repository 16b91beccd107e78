#pragma once
#include <vector>

#include <welkin/envmap/zonal_kernel.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// One look-up of filter_quick, in a frame whose z axis is the direction that is filtered for.
struct QuickTap {
  Vec3 direction;        ///< unit length
  double deviation = 0;  ///< of the footprint, along an axis (rad)
  double weight = 0;     ///< >= 0; all together 1
};

/// Taps that stand in for a kernel, and how well.
struct QuickTaps {
  std::vector<QuickTap> taps;
  /// What the fit expects of the relative RMS error on white noise or under one small lamp.
  double predicted_rms = 0;
};

/// The best `count` Gaussian look-ups (2 to 64) for a kernel, none narrower than least_deviation (rad). Rings of
/// equal taps around the axis; their angles, footprints and weights minimise the mean squared error of the filtered
/// map over white maps, with footprints a little wider or narrower than they should be. Derivation in quick_taps.cpp.
/// The same result every time. Throws Error for a count out of range.
QuickTaps fit_quick_taps(const ZonalKernel& kernel, int count, double least_deviation);

}  // namespace welkin
