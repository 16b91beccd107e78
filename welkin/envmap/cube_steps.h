#pragma once
#include <welkin/image/image.h>

namespace welkin {

/// Mean absolute step between neighbouring texels (all channels) across the 12 edges of a cube, over the mean step
/// between neighbours inside faces along the lines that meet those edges at right angles, both divided by the angle
/// between the texel centres: 1 for a smooth function, more where faces were filtered apart. 0 when size < 2 or the
/// cube has no steps.
double edge_step_ratio(const Cube& cube);

/// Sum over the texels of luminance * solid angle (3 channels).
double cube_energy(const Cube& cube);

}  // namespace welkin
