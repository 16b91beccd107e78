#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

// Pixels as texture files and GPUs store them: half and float channels, and three channels that share one
// exponent. All are little-endian, as the files and every supported machine are.

namespace welkin {

/// The formats that textures are written in.
enum class PixelFormat { rgba16f, rgba32f, rgb9e5, rg16f, rg32f };

/// How one pixel lies in memory: `channels` components one after the other, or one packed word of 4 bytes.
struct PixelLayout {
  enum class Component { half, float32, shared_exponent };
  Component component = Component::half;
  int channels = 4;

  std::size_t bytes() const {
    if (component == Component::shared_exponent) return 4;
    return static_cast<std::size_t>(channels) * (component == Component::half ? 2 : 4);
  }
};

/// The layout of a format.
PixelLayout pixel_layout(PixelFormat format);

/// "rgba16f" and so on.
std::string_view pixel_format_name(PixelFormat format);

/// The largest value that a channel of the format can hold: 65504 (half), 65408 (rgb9e5), 3.4e38 (float).
float pixel_format_max(PixelFormat format);

/// Whether negative values can be stored (rgb9e5 has no sign).
bool pixel_format_has_sign(PixelFormat format);

inline constexpr float rgb9e5_max = 65408.0f;  // 511/512 2^16

/// E5B9G9R9 (red mantissa in bits 0-8, green 9-17, blue 18-26, exponent 27-31): each channel is mantissa 2^(E
/// - 24). The exponent is the smallest that leaves the largest channel closest to its value, then every
/// channel is rounded to nearest (ties to even). Values above 65408 become 65408, negative ones and NaN
/// become 0; each of these adds one to `clipped`.
std::uint32_t rgb9e5_from_floats(const float rgb[3], std::size_t& clipped);

/// The exact three values of an E5B9G9R9 word.
void floats_from_rgb9e5(std::uint32_t word, float rgb[3]);

/// Writes pixels with `channels` (1 to 4) floats each as `format`, every value multiplied by `factor` first
/// (a power of two, so that nothing is rounded twice). One channel is repeated as gray; a format with more
/// colour channels than the source gets zeros there; alpha is written as 1; channels beyond the format's are
/// dropped. Values that do not fit are saturated, NaN becomes 0. `bytes` has pixels *
/// pixel_layout(format).bytes() elements. Returns how many channel values were changed by saturation. Runs on
/// all threads.
std::size_t encode_pixels(std::span<const float> pixels, int channels, float factor, PixelFormat format,
                          std::span<std::uint8_t> bytes);

/// The reverse for any layout, into three floats a pixel, each multiplied by `factor`: a fourth channel is
/// dropped, a missing third is 0. rgb.size() == 3 * pixels and bytes.size() == pixels * layout.bytes(). Runs
/// on all threads.
void decode_pixels(std::span<const std::uint8_t> bytes, PixelLayout layout, float factor,
                   std::span<float> rgb);

}  // namespace welkin
