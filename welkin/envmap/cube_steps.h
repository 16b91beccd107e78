#pragma once
#include <welkin/image/image.h>

namespace welkin {

/// Mean absolute step (all channels) between neighbouring texels across the 12 edges of a cube, over the step that the
/// texels inside the two faces predict there: 1 for a function that knows nothing of faces, more where faces were
/// filtered apart. Steps are taken per unit of the way at right angles to the edge. The prediction is extrapolated from the two nearest steps on either side. For smooth content: noise from texel to texel predicts
/// nothing. 0 when there is nothing to step over, or too little to predict from (size < 6).
double edge_step_ratio(const Cube& cube);

/// The integral of luminance over the sphere (3 channels), from texels that are samples of a smooth function at their
/// centres: the midpoint rule on each face, with its leading error removed by end corrections where a face has four
/// texels or more, so O(size^-4). Scaled so that it is exact for constants. For coarse levels a plain sum of texels
/// times solid angles would measure the sampling, not the level.
double cube_energy(const Cube& cube);

}  // namespace welkin
