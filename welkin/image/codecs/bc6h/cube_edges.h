#pragma once
#include <array>
#include <vector>

namespace welkin::bc6h {

/// A texel of a cube.
struct CubeTexel {
  int face = 0, x = 0, y = 0;
};

/// The sides of a face: left, right, top, bottom.
inline constexpr int side_count = 4;

/// The texel on the other side of the cube's edge from texel `along` (0 to size - 1, rightwards or downwards) of a
/// side of a face.
CubeTexel across_edge(int size, int face, int side, int along);

/// Texel `along` of a side.
CubeTexel on_side(int size, int face, int side, int along);

/// The side of its face on which a texel next to `from_face` lies.
int side_towards(CubeTexel texel, int from_face, int size);

}  // namespace welkin::bc6h
