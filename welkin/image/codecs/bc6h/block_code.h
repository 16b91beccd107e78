#pragma once
#include <array>
#include <cstdint>

#include <welkin/image/codecs/bc6h/bc6h.h>
#include <welkin/image/codecs/bc6h/layout.h>

namespace welkin::bc6h {

/// What a block says, in plain numbers: endpoints as codes of the mode's endpoint_bits (two's complement when signed),
/// offsets already added; indices with their implied bits.
struct BlockCode {
  int mode = 0;       // place in `modes`
  int partition = 0;  // of two-subset modes
  std::array<std::array<int, 3>, 4> endpoints{};
  std::array<std::uint8_t, texel_count> indices{};
};

/// False for the reserved modes.
bool unpack(const Bc6hBlock& block, bool is_signed, BlockCode& code);

/// The reverse. The anchors' highest index bits are 0 and the offsets of transformed modes fit (can_pack).
Bc6hBlock pack(const BlockCode& code);

/// Whether all offsets of a transformed mode fit their bits.
bool offsets_fit(const BlockCode& code);

/// The 16 texels as halves, sign and magnitude.
void decode(const BlockCode& code, bool is_signed, std::uint16_t halves[48]);

/// The subset of a texel: bit `texel` of its partition, 0 in one-subset modes.
constexpr int subset_of(const BlockCode& code, int texel) {
  return modes[static_cast<std::size_t>(code.mode)].subsets == 1
             ? 0
             : (partitions[static_cast<std::size_t>(code.partition)] >> texel) & 1;
}

/// The texel of a subset whose highest index bit is not stored.
constexpr int anchor_of(const BlockCode& code, int subset) {
  return subset == 0 ? 0 : second_anchors[static_cast<std::size_t>(code.partition)];
}

}  // namespace welkin::bc6h
