#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

// What the PNG and the JPEG reader hand to decode_ldr. Each keeps its library (libpng, TurboJPEG) to its own file.

namespace welkin {

/// A picture as its file stores it: RGB, row 0 at the top, no padding, not yet linear. `bytes` has width * height * 3
/// samples of 8 bits, or of 16 with the high byte first.
struct LdrSamples {
  int width = 0;
  int height = 0;
  int bits = 8;
  std::vector<std::uint8_t> bytes;
};

/// Read a whole file. Palettes are looked up, gray is repeated, 1, 2 and 4 bits are spread over 0..255, alpha is
/// dropped. Throw Error(name, ...) for what is damaged, cut off or larger than `bytes` can hold, the latter before memory
/// is taken.
LdrSamples read_png(std::span<const std::uint8_t> bytes, std::string_view name);
LdrSamples read_jpeg(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace welkin
