#pragma once
#include <welkin/sphere/texel_weights.h>

// Inside of resample.cpp: an equirectangular map to a cube with the weights of one sixteenth of the texels.

namespace welkin {

/// Whether resample_mirrored can do it: equirectangular to cube, with columns that fall onto columns when the map is
/// turned by a quarter.
bool has_mirrors(MapShape source, MapShape target);

/// What resample does texel by texel, for such shapes and no turn: the same up to rounding.
void resample_mirrored(const ResampleGeometry& geometry, SphereMap& result);

}  // namespace welkin
