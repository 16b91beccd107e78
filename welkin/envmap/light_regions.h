#pragma once
#include <cstdint>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// A connected set of texels that outshines what is around it.
struct LightRegion {
  std::vector<std::uint32_t> texels;  ///< y * width + x, brightest first
  double solid_angle = 0;             ///< sr
  Vec3 area_moment;                   ///< integral of the direction over the region
  double flux = 0;                    ///< integral of luminance over the region, W/m^2
};

struct LightRegionOptions {
  double max_angular_radius = 0.05;  ///< rad, of the disc that is spread as the region is
  double edge_over_peak = 1e-3;      ///< a region ends where luminance falls to this share of its peak
  double floor_over_mean = 4;  ///< texels below this many times the map's mean luminance are never light
};

/// Radius (rad) of the uniform disc of the same second moment: for a disc of radius a about d the mean of 1 - cos of
/// the angle to d is a^2/4 - O(a^4), and 1 - |mean direction| is just that.
double equivalent_radius(double solid_angle, Vec3 area_moment);

/// The largest compact regions: over all thresholds, the connected sets of texels above the threshold (8 neighbours,
/// across the seam and the poles) that are still as small and as steep as the options ask, when any lower threshold
/// would break that. Disjoint; the one with the largest flux first. equirect has 3 channels, finite and >= 0.
///
/// It is one walk down the tree of connected components (Salembier et al. 1998) by union-find over the texels in the
/// order of their luminance, O(n log n) in the number of texels above the floor.
std::vector<LightRegion> find_light_regions(const Image& equirect, const LightRegionOptions& options = {});

}  // namespace welkin
