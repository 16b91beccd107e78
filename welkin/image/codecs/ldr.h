#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <welkin/image/byte_image.h>
#include <welkin/image/image.h>
#include <welkin/image/loaded_image.h>

// Pictures of low dynamic range: PNG and JPEG, read through the stb library, which stays behind ldr.cpp; PNG
// is written through libpng, behind png_write.cpp.

namespace welkin {

/// Decodes a PNG (1 to 16 bits) or a baseline or progressive JPEG. Values are taken as sRGB and made linear,
/// 0 to 1; alpha is dropped, gray repeated, embedded profiles and gamma are not applied. The result always
/// carries the warning that such a file is not HDR. Throws Error naming `name` for other formats and damaged
/// or truncated files.
LoadedImage decode_ldr(std::span<const std::uint8_t> bytes, std::string_view name);

/// Encodes 8-bit gray (1 channel) or RGB (3) as PNG.
std::vector<std::uint8_t> encode_png(const ByteImage& image);

}  // namespace welkin
