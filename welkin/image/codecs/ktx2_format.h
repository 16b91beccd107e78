#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <welkin/image/packed_formats.h>

// What KTX 2.0 says about each of our formats: Vulkan's number, the size of its type, its data format
// descriptor.

namespace welkin {

inline constexpr std::array<std::uint8_t, 12> ktx2_identifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                                 '0',  0xBB, '\r', '\n', 0x1A, '\n'};
inline constexpr std::size_t ktx2_header_size = 80;       ///< up to the level index
inline constexpr std::size_t ktx2_level_entry_size = 24;  ///< byteOffset, byteLength, uncompressedByteLength

inline constexpr std::uint32_t ktx2_scheme_none = 0;
inline constexpr std::uint32_t ktx2_scheme_zstd = 2;

inline constexpr std::string_view ktx2_scale_key = "WelkinStoredScale";

struct Ktx2Format {
  std::uint32_t vk_format = 0;
  std::uint32_t type_size = 0;
  PixelLayout layout;
  std::string_view name;
};

/// The entry of a format that we write.
const Ktx2Format& ktx2_format(PixelFormat format);

/// The entry of single floats with 1 to 4 channels.
const Ktx2Format& ktx2_float_format(int channels);

/// The entry with this VkFormat; null for one that we do not read.
const Ktx2Format* find_ktx2_format(std::uint32_t vk_format);

/// The alignment of a level's first byte: lcm(bytes of a pixel or block, 4), or 1 when supercompressed.
std::size_t ktx2_level_alignment(PixelLayout layout, bool supercompressed);

/// The data format descriptor as words, its total size first: one basic block (Khronos Data Format
/// Specification 1.3, block version 2), model RGBSDA, BC6H or ASTC, primaries BT.709, transfer linear, straight alpha.
/// bytesPlane0 is the size of a pixel or block with or without supercompression (KTX 2.0 revision 4; older revisions
/// had 0 when supercompressed, at which today's validators warn).
std::vector<std::uint32_t> ktx2_data_format_descriptor(PixelLayout layout);

}  // namespace welkin
