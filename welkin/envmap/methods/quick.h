#pragma once
#include <welkin/envmap/filter.h>

namespace welkin {

struct QuickOptions {
  int taps = 16;  ///< look-ups a texel, 2 to 64
};

/// A few look-ups in a B-spline mip chain of a cube (after Manson & Sloan 2016, "Fast filtering of reflection probes"):
/// where the taps lie around the direction, how wide and how heavy they are comes from a fit to the kernel
/// (fit_quick_taps); the mip level of each follows the size of texels where it falls, so that its footprint is the
/// same all over the sphere. The pattern is turned by the direction's east and north, so no seams at edges.
/// Artefacts: a sharp light becomes as many soft spots as there are taps where these do not overlap (few taps, wide
/// tails); footprints stretch with texels in the corners of the cube; the pattern swirls around +Y and -Y.
/// Measured relative RMS with 16 taps: 1 to 4 % on photographs of a sunset and of a night street, 4 to 18 % where a
/// few lamps or a hard sun are nearly all; see docs/approximate-filters.md. Throws Error for a number of taps out of
/// range.
Cube filter_quick(const Image& radiance, const FilterTarget& target, const QuickOptions& options = {});

}  // namespace welkin
