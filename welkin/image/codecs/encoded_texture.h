#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace welkin {

/// A texture file in memory, and what its format did to the values.
struct EncodedTexture {
  std::vector<std::uint8_t> bytes;
  double stored_scale = 1;  ///< a power of two: true value = value in the file * stored_scale
  std::size_t clipped =
      0;  ///< channel values (alpha not counted) that saturated, or were NaN, or lost their sign
};

}  // namespace welkin
