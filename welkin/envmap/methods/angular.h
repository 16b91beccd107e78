#pragma once
#include <functional>

#include <welkin/envmap/filter.h>

namespace welkin {

struct AngularOptions {
  /// The share of the lobe's energy that is cut off, 1e-9 to 0.5.
  double cut_energy = 1e-3;
  /// The edge of the source cube, 1 to 4096; 0: as fine as the map (matching_cube_size).
  int source_size = 0;
  /// Told the share done, in [0, 1], from the calling thread.
  std::function<void(double)> progress{};
};

/// Angular extent with a cut-off (ATI's CubeMapGen: Isidoro & Mitchell 2005): the map as a cube; the lobe ends at the angle beyond which
/// `cut_energy` of it lies; each face is summed only within the rectangle that bounds that cap on it; weights K(texel
/// centre) * solid angle, divided by their sum. The rectangles are exact (the range of longitudes of a cap about either
/// axis of the face), so no texel of the cap is missed at edges and corners.
/// Artefact: the cut: what a lamp gives beyond the angle is missing, a disc with a hard rim about it; and a lobe
/// narrower than the source's texels turns into single texels. Stated error: see docs/filters.md.
/// Throws Error for options out of range.
Cube filter_angular(const Image& radiance, const FilterTarget& target, const AngularOptions& options = {});

}  // namespace welkin
