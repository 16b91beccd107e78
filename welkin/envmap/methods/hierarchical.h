#pragma once
#include <functional>

#include <welkin/envmap/filter.h>

namespace welkin {

struct HierarchicalOptions {
  /// Nodes of the pyramid per scale of the kernel: a node of half size h is taken whole where `detail` * h is no more
  /// than hypot(angular_width, distance from the axis). 0.5 to 64.
  double detail = 4;
  /// Told the share done, in [0, 1], from the calling thread.
  std::function<void(double)> progress{};
};

/// Coarser source for wider parts of the lobe (Kautz, Vazquez, Heidrich & Seidel 2000): a pyramid of the map, each node the
/// mean of its patch; the lobe is cut into parts, rings about its axis, and each is summed over the coarsest nodes that are
/// small against the scale on which the kernel varies there. Weights K(centre) * solid angle, divided by their sum.
/// Where the map's own texels are too coarse, the kernel is integrated over them.
/// Artefact: light moves to the centre of the node that it lies in, so far lamps wander by half a node from texel to
/// texel, and rings show where the level changes. Stated error: see docs/filters.md.
/// Throws Error for detail out of range.
Cube filter_hierarchical(const Image& radiance, const FilterTarget& target,
                         const HierarchicalOptions& options = {});

}  // namespace welkin
