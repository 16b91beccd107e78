#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

// What the PNG and the JPEG reader hand to decode_ldr. Each keeps its library (libpng, TurboJPEG) to its own file.

namespace welkin {

/// A picture as its file stores it: RGB or RGBA, row 0 at the top, no padding, not yet linear. `bytes` has
/// width * height * channels samples of 8 bits, or of 16 with the high byte first.
struct LdrSamples {
  int width = 0;
  int height = 0;
  int bits = 8;
  int channels = 3;
  std::vector<std::uint8_t> bytes;
};

/// Read a whole file. Palettes are looked up, gray is repeated, 1, 2 and 4 bits are spread over 0..255, alpha is
/// dropped unless `keep_alpha`; then a file that has it gives 4 channels. Throw Error(name, ...) for what is damaged, cut off or larger than `bytes` can hold, the latter before memory
/// is taken.
LdrSamples read_png(std::span<const std::uint8_t> bytes, std::string_view name, bool keep_alpha = false);
LdrSamples read_jpeg(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace welkin
