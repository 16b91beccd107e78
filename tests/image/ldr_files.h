#pragma once
#include <turbojpeg.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <welkin/image/byte_image.h>

// Writes PNG and JPEG files of every form that the readers must take, by libpng and TurboJPEG themselves.

namespace welkin {

/// A colour type of PNG as its number in the file: the sum of palette 1, colour 2 and alpha 4.
enum class PngColor : std::uint8_t { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgba = 6 };

/// Samples stored per pixel.
int channel_count(PngColor color);

struct PngForm {
  int width = 13;  // with 11 rows: every pass of an interlaced file is cut at both sides
  int height = 11;
  PngColor color = PngColor::rgb;
  int bits = 8;
  bool interlaced = false;
  bool transparent_color = false;  ///< a tRNS chunk; not for forms with alpha
  bool ancillary = false;          ///< gAMA 1.0 and a text, which readers must not apply
  std::vector<std::array<std::uint8_t, 3>> palette = {};
};

/// `sample` gives the stored number, 0 to 2^bits - 1, of channel c of pixel (x, y).
using PngSample = std::function<int(int x, int y, int c)>;
std::vector<std::uint8_t> png_file(const PngForm& form, const PngSample& sample);

struct JpegForm {
  int subsampling = TJSAMP_420;
  int quality = 90;
  bool progressive = false;
};
/// RGB or gray, by the channels of the image; gray is stored as gray.
std::vector<std::uint8_t> jpeg_file(const ByteImage& image, const JpegForm& form = {});
/// A CMYK file of one colour.
std::vector<std::uint8_t> cmyk_jpeg_file();

}  // namespace welkin
