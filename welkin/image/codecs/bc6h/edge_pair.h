#pragma once
#include <array>

#include <welkin/image/codecs/bc6h/search.h>

namespace welkin::bc6h {

/// A block that lies with one side along an edge of a cube: its targets, that side (left, right, top, bottom), and the
/// four texels of the side in the order in which the other block has its own.
struct EdgeBlock {
  Targets targets;
  int side = 0;
  std::array<int, 4> texels{};
};

/// Codes for the two blocks along a piece of edge, whose side texels have the same targets, such that these texels decode
/// to the same values. Neither block becomes brighter than its limit.
std::array<BlockCode, 2> encode_edge_pair(const std::array<EdgeBlock, 2>& blocks);

}  // namespace welkin::bc6h
