#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <welkin/image/byte_image.h>
#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>

// Pictures of low dynamic range: PNG and JPEG, read and written through libpng (png_read.cpp, png_write.cpp) and
// TurboJPEG (jpeg_read.cpp, jpeg_write.cpp).

namespace welkin {

/// Decodes a PNG (1 to 16 bits) or a baseline or progressive JPEG. Values are taken as sRGB and made linear,
/// 0 to 1; alpha is dropped, gray repeated, embedded profiles and gamma are not applied. The result always
/// carries the warning that such a file is not HDR. Throws Error naming `name` for other formats, CMYK, unusual
/// subsampling of a JPEG's colour (the common ones are 4:4:4, 4:2:2, 4:4:0, 4:2:0 and 4:1:1), PNGs with a side above
/// 1,000,000, and for anything damaged or truncated: a wrong check sum or a warning of the library counts as damage.
LoadedImage decode_ldr(std::span<const std::uint8_t> bytes, std::string_view name);

/// What the numbers of a texture are: colours through the sRGB curve, or plain numbers (normals, roughness).
enum class LdrEncoding : std::uint8_t { srgb, linear };

/// The same for a texture: linear values, 0 to 1, with 4 channels where a PNG has alpha (which is never encoded), else 3.
Image decode_ldr_texture(std::span<const std::uint8_t> bytes, std::string_view name, LdrEncoding encoding);

/// The same from a picture of 3 or 4 channels that somebody else (a browser) has decoded; alpha is straight.
Image linear_texture(const ByteImage& picture, LdrEncoding encoding);

/// Encodes 8-bit gray (1 channel) or RGB (3) as PNG.
std::vector<std::uint8_t> encode_png(const ByteImage& image);

/// Encodes the same as a baseline JPEG with full colour (4:4:4); quality 1 to 100. For pictures in documents. Throws Error
/// for sides above 65500.
std::vector<std::uint8_t> encode_jpeg(const ByteImage& image, int quality = 85);

}  // namespace welkin
