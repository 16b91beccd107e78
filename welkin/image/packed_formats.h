#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

// Pixels as texture files and GPUs store them: half and float channels, three channels that share one exponent, three
// small floats in a word, and blocks of texels that are compressed together (welkin/image/codecs/texture_surface.h
// makes and reads those). All are little-endian, as the files and every supported machine are.

namespace welkin {

/// The formats that textures are written in.
enum class PixelFormat {
  rgba16f,
  rgba32f,
  rgb9e5,
  rg16f,
  rg32f,
  r11g11b10f,   ///< B10G11R11_UFLOAT_PACK32: 6, 6 and 5 mantissa bits with an exponent each
  bc6h,         ///< unsigned BC6H (BC6H_UF16), blocks of 4 x 4
  bc6h_signed,  ///< signed BC6H (BC6H_SF16)
  astc,         ///< ASTC HDR, blocks of 4 x 4
  astc6x6       ///< ASTC HDR, blocks of 6 x 6
};

/// How one pixel lies in memory: `channels` components one after the other, one packed word of 4 bytes, or, for the
/// last three components, a block of 16 bytes for block_width x block_height pixels.
struct PixelLayout {
  enum class Component { half, float32, shared_exponent, small_floats, bc6h_unsigned, bc6h_signed, astc_hdr };
  Component component = Component::half;
  int channels = 4;
  int block_width = 1, block_height = 1;

  bool is_block() const { return component >= Component::bc6h_unsigned; }
  /// Of a pixel, or of a block.
  std::size_t bytes() const {
    if (is_block()) return 16;
    if (component == Component::shared_exponent || component == Component::small_floats) return 4;
    return static_cast<std::size_t>(channels) * (component == Component::half ? 2 : 4);
  }
  /// Of one image; blocks that reach over its right and lower side count whole. Sides are at least 1.
  std::size_t image_bytes(int width, int height) const {
    const auto columns = static_cast<std::size_t>((width - 1) / block_width + 1);
    return columns * static_cast<std::size_t>((height - 1) / block_height + 1) * bytes();
  }
};

/// The layout of a format.
PixelLayout pixel_layout(PixelFormat format);

/// "rgba16f" and so on, as the enumerators are called.
std::string_view pixel_format_name(PixelFormat format);

/// The format of that name, one of those with three colour channels; nothing for any other name.
std::optional<PixelFormat> colour_format_from_name(std::string_view name);

/// The largest value that every channel of the format can hold: 65504 (half, and what blocks decode to), 65408
/// (rgb9e5), 64512 (r11g11b10f: its blue; red and green reach 65024), 3.4e38 (float).
float pixel_format_max(PixelFormat format);

/// Whether negative values can be stored (not in rgb9e5, r11g11b10f, bc6h, astc).
bool pixel_format_has_sign(PixelFormat format);

inline constexpr float rgb9e5_max = 65408.0f;         // 511/512 2^16
inline constexpr float r11g11b10f_max_rg = 65024.0f;  // (2 - 2^-6) 2^15
inline constexpr float r11g11b10f_max_b = 64512.0f;   // (2 - 2^-5) 2^15

/// E5B9G9R9 (red mantissa in bits 0-8, green 9-17, blue 18-26, exponent 27-31): each channel is mantissa 2^(E
/// - 24). The exponent is the smallest that leaves the largest channel closest to its value, then every
/// channel is rounded to nearest (ties to even). Values above 65408 become 65408, negative ones and NaN
/// become 0; each of these adds one to `clipped`.
std::uint32_t rgb9e5_from_floats(const float rgb[3], std::size_t& clipped);

/// The exact three values of an E5B9G9R9 word.
void floats_from_rgb9e5(std::uint32_t word, float rgb[3]);

/// B10G11R11_UFLOAT_PACK32 (red in bits 0-10, green 11-21, blue 22-31; Vulkan specification, unsigned 11-bit and
/// 10-bit floats): 5 exponent bits (bias 15) and 6, 6, 5 mantissa bits, no sign, denormals below 2^-14. Every channel
/// is rounded to nearest, ties to even. Values above 65024 (red, green) and 64512 (blue) become that, negative ones
/// and NaN 0; each of these adds one to `clipped`.
std::uint32_t r11g11b10f_from_floats(const float rgb[3], std::size_t& clipped);

/// The exact three values of such a word; infinity and NaN, which the encoder never writes, come as such.
void floats_from_r11g11b10f(std::uint32_t word, float rgb[3]);

/// Writes pixels with `channels` (1 to 4) floats each as `format`, every value multiplied by `factor` first
/// (a power of two, so that nothing is rounded twice). One channel is repeated as gray; a format with more
/// colour channels than the source gets zeros there; alpha is written as 1; channels beyond the format's are
/// dropped. Values that do not fit are saturated, NaN becomes 0. `bytes` has pixels *
/// pixel_layout(format).bytes() elements; not for formats of blocks. Returns how many channel values were changed by saturation. Runs on
/// all threads.
std::size_t encode_pixels(std::span<const float> pixels, int channels, float factor, PixelFormat format,
                          std::span<std::uint8_t> bytes);

/// The reverse for any layout, into three floats a pixel, each multiplied by `factor`: a fourth channel is dropped, a
/// missing third is 0, a single one is repeated as gray. rgb.size() == 3 * pixels and bytes.size() == pixels *
/// layout.bytes(). Runs on all threads.
void decode_pixels(std::span<const std::uint8_t> bytes, PixelLayout layout, float factor,
                   std::span<float> rgb);

}  // namespace welkin
