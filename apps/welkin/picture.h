#pragma once
#include <string_view>

#include <welkin/image/byte_image.h>

// Drawing for contact sheets: copies, boxes and captions in RGB byte images (3 channels). Whatever lies outside the
// target is cut off.

namespace welkin {

/// A colour as it is stored: 8 bits, sRGB-encoded.
struct ByteColour {
  std::uint8_t r = 0, g = 0, b = 0;
};

void fill_box(ByteImage& target, int x, int y, int width, int height, ByteColour colour);

/// Copies `source` with its top left pixel at (x, y).
void blit(const ByteImage& source, ByteImage& target, int x, int y);

/// The mean of each factor x factor block of encoded values; width and height are multiples of factor >= 1. Taking the
/// mean after tone mapping, not before, is what keeps the edges of very bright things smooth.
ByteImage shrink(const ByteImage& source, int factor);

/// Rows of a line of text, times scale.
inline constexpr int text_height = 7;

/// Pixels that draw_text covers: 5 a glyph and 1 between two, times scale.
int text_width(std::string_view text, int scale);

/// Writes a line with its top left at (x, y), each dot scale x scale pixels. Lower case is drawn as capitals; what
/// the font lacks is drawn as a space. Returns the x behind it where more text can go on.
int draw_text(ByteImage& target, int x, int y, int scale, std::string_view text, ByteColour colour);

}  // namespace welkin
