#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>

// OpenEXR (.exr), through the OpenEXR 3 library, which stays behind exr.cpp and exr_write.cpp.

namespace welkin {

/// Decodes the first flat (not deep) part: scan lines or tiles (the full resolution level), half, float or
/// uint, any compression. Colour is taken from R, G, B; else from Y with RY and BY (chroma is upsampled
/// bilinearly), else from Y alone as gray; else from the first layer that has R, G and B (a warning names
/// it); else from the only channel. Alpha is dropped and colour stays as stored (premultiplied). Colours are
/// converted to Rec.709 if the file's chromaticities are others (with a warning; white points are mapped onto
/// each other by scaling in XYZ). The result covers the display window: black where the data window has no
/// pixels, overscan cropped, either with a warning. stored_scale is read back from files of encode_exr.
/// Throws Error naming `name` for anything damaged, truncated, too large, deep only, or without colour.
LoadedImage decode_exr(std::span<const std::uint8_t> bytes, std::string_view name);

enum class ExrPixelType { half_float, single_float };

struct ExrOptions {
  ExrPixelType pixel_type = ExrPixelType::half_float;
  double stored_scale =
      1;  ///< pixels are written divided by it; the file names it and decode_exr multiplies it back in
};

/// Encodes 1 (Y), 3 (R, G, B) or 4 (R, G, B, A) channels as scan lines with ZIP compression, Rec.709. Half
/// floats are rounded to nearest even and saturate at +-65504 (infinity too); NaN stays.
std::vector<std::uint8_t> encode_exr(const Image& image, const ExrOptions& options = {});

}  // namespace welkin
