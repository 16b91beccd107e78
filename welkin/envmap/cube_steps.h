#pragma once
#include <welkin/image/image.h>

namespace welkin {

/// Mean absolute step between neighbouring texels (all channels) across the 12 edges of a cube, over the mean step
/// between neighbours inside faces along the lines that meet those edges at right angles, both divided by the angle
/// between the texel centres: 1 for a smooth function, more where faces were filtered apart. 0 when size < 2 or the
/// cube has no steps.
double edge_step_ratio(const Cube& cube);

/// The integral of luminance over the sphere (3 channels), from texels that are samples of a smooth function at their
/// centres: the midpoint rule on each face, with its leading error removed by end corrections where a face has four
/// texels or more, so O(size^-4). Scaled so that it is exact for constants. For coarse levels a plain sum of texels
/// times solid angles would measure the sampling, not the level.
double cube_energy(const Cube& cube);

}  // namespace welkin
