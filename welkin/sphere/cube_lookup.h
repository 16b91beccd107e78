#pragma once
#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

// Cube look-ups as a GPU with seamless filtering does them (OpenGL ES 3.0.6, section 3.8.10): what a consumer of our
// files sees.

namespace welkin {

/// Bilinear look-up in a direction of any length > 0, to out (one per channel): texels beyond an edge come from the
/// neighbouring face, the missing fourth texel at a corner is the mean of the other three.
void look_up_cube(const Cube& cube, Vec3 direction, float* out);

/// Trilinear look-up: level is clamped to [0, levels - 1], its two neighbours are blended.
void look_up_cube(const CubeMips& cube, Vec3 direction, double level, float* out);

}  // namespace welkin
