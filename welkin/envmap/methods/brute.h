#pragma once
#include <functional>

#include <welkin/envmap/filter.h>

namespace welkin {

struct BruteOptions {
  /// Told the share of the work done so far, in [0, 1], from the calling thread.
  std::function<void(double)> progress;
};

/// Every texel of the map for every texel of the cube, in double (Greene 1986): filter_brute_force at texel centres.
/// Artefact: none but the time it takes. Stated error: 1e-7 a texel by design, 3e-5 across a kernel's kink at 90 degrees; then the
/// rounding to float.
Cube filter_brute(const Image& radiance, const FilterTarget& target, const BruteOptions& options = {});

}  // namespace welkin
