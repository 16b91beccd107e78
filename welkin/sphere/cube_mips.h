#pragma once
#include <welkin/image/image.h>

namespace welkin {

/// The mip chain of a cube by exact areas: each texel of a level is the mean radiance of the level above over its
/// patch, weighted by solid angle (exact atan form), so that every level has the energy of level 0. Level k has size
/// max(1, size >> k), odd sizes included. `levels` <= 0 asks for all of them, down to size 1; so do more levels
/// than the size has.
CubeMips build_mips(Cube cube, int levels = 0);

}  // namespace welkin
