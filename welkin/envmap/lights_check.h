#pragma once
#include <welkin/envmap/lights.h>

namespace welkin {

/// How far residual + lights are from the map, over the irradiance of surfaces in all directions. Luminance, as a share
/// of `largest_irradiance`.
struct RecombinationErrors {
  double directional_rms = 0, directional_max = 0;  ///< lights as directions without extent
  double disc_rms = 0, disc_max = 0;                ///< lights as discs of their angular radius
  double largest_irradiance = 0;  ///< of the map over the same normals, by degree 20 (to about 1 %), W/m^2
};

/// Exact in the texels, each a point at its centre: only those that the extraction changed are summed, for
/// `normals` directions over the sphere and 64 a light about the ring at right angles to it, where directions err most.
RecombinationErrors check_recombination(const Image& map, const ExtractedLights& extracted,
                                        int normals = 1000);

}  // namespace welkin
