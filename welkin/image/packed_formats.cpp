#include <welkin/image/packed_formats.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

#include <welkin/image/half.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels are copied to files as they lie in memory");

using Component = PixelLayout::Component;

struct FormatFacts {
  std::string_view name;
  PixelLayout layout;
  float max;
};

constexpr float float_max = std::numeric_limits<float>::max();

// In the order of PixelFormat.
constexpr std::array<FormatFacts, 10> formats = {{
    {"rgba16f", {Component::half, 4}, half_max},
    {"rgba32f", {Component::float32, 4}, float_max},
    {"rgb9e5", {Component::shared_exponent, 3}, rgb9e5_max},
    {"rg16f", {Component::half, 2}, half_max},
    {"rg32f", {Component::float32, 2}, float_max},
    {"r11g11b10f", {Component::small_floats, 3}, r11g11b10f_max_b},
    {"bc6h", {Component::bc6h_unsigned, 3, 4, 4}, half_max},
    {"bc6h_signed", {Component::bc6h_signed, 3, 4, 4}, half_max},
    {"astc", {Component::astc_hdr, 3, 4, 4}, half_max},
    {"astc6x6", {Component::astc_hdr, 3, 6, 6}, half_max},
}};

const FormatFacts& facts(PixelFormat format) { return formats.at(static_cast<std::size_t>(format)); }

float power_of_two(int exponent) {
  assert(exponent >= -126 && exponent <= 127);
  return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}

float clamped_channel(float value, float max, std::size_t& clipped) {
  const bool inside = value >= 0 && value <= max;  // false for NaN
  clipped += inside ? 0 : 1;
  return inside ? std::abs(value) : (value > 0 ? max : 0.0f);  // abs: -0 has no place either
}

// A float with 5 exponent bits (bias 15) and `mantissa` bits. `value` is finite, >= 0 and at most the largest. Below
// 2^-14 the unit is 2^(-14 - mantissa): the addition of 2^23 rounds to it, and a carry gives the code of 2^-14 itself.
// Above, half a unit less one, plus one where the last bit that stays is odd, carries exactly where rounding goes up.
std::uint32_t small_float(float value, unsigned mantissa) {
  if (value < 0x1p-14f) {
    const float units = value * power_of_two(14 + static_cast<int>(mantissa));
    return std::bit_cast<std::uint32_t>(units + 0x1p23f) & 0x7fu;
  }
  const unsigned dropped = 23 - mantissa;
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t rounded = bits + (1u << (dropped - 1)) - 1 + ((bits >> dropped) & 1u);
  return (rounded - (112u << 23)) >> dropped;
}

float float_from_small(std::uint32_t code, unsigned mantissa) {
  const std::uint32_t exponent = code >> mantissa, fraction = code & ((1u << mantissa) - 1);
  if (exponent == 0) return static_cast<float>(fraction) * power_of_two(-14 - static_cast<int>(mantissa));
  const std::uint32_t wide = exponent == 31 ? 255 : exponent + 112;
  return std::bit_cast<float>((wide << 23) | (fraction << (23 - mantissa)));
}

float saturated_float(float value, std::size_t& clipped) {
  const bool finite = std::abs(value) <= float_max;
  clipped += finite ? 0 : 1;
  return finite ? value : (value > 0 ? float_max : (value < 0 ? -float_max : 0.0f));
}

// One pixel of the source as R, G, B and alpha = 1.
std::array<float, 4> gather(const float* pixel, int channels, float factor) {
  if (channels == 1) return {factor * pixel[0], factor * pixel[0], factor * pixel[0], 1.0f};
  return {factor * pixel[0], factor * pixel[1], channels > 2 ? factor * pixel[2] : 0.0f, 1.0f};
}

std::size_t encode_pixel(const std::array<float, 4>& rgba, PixelLayout layout, std::uint8_t* out) {
  std::size_t clipped = 0;
  const auto count = static_cast<std::size_t>(layout.channels);
  if (layout.component == Component::shared_exponent) {
    const std::uint32_t word = rgb9e5_from_floats(rgba.data(), clipped);
    std::memcpy(out, &word, sizeof word);
  } else if (layout.component == Component::small_floats) {
    const std::uint32_t word = r11g11b10f_from_floats(rgba.data(), clipped);
    std::memcpy(out, &word, sizeof word);
  } else if (layout.component == Component::half) {
    std::array<std::uint16_t, 4> codes{};
    for (std::size_t c = 0; c < count; ++c) codes[c] = half_saturated(rgba[c], clipped);
    std::memcpy(out, codes.data(), count * sizeof(std::uint16_t));
  } else {
    std::array<float, 4> values{};
    for (std::size_t c = 0; c < count; ++c) values[c] = saturated_float(rgba[c], clipped);
    std::memcpy(out, values.data(), count * sizeof(float));
  }
  return clipped;
}

void decode_pixel(const std::uint8_t* in, PixelLayout layout, float factor, float* rgb) {
  std::array<float, 4> values{};
  const auto count = static_cast<std::size_t>(layout.channels);
  if (layout.component == Component::shared_exponent) {
    std::uint32_t word = 0;
    std::memcpy(&word, in, sizeof word);
    floats_from_rgb9e5(word, values.data());
  } else if (layout.component == Component::small_floats) {
    std::uint32_t word = 0;
    std::memcpy(&word, in, sizeof word);
    floats_from_r11g11b10f(word, values.data());
  } else if (layout.component == Component::half) {
    std::array<std::uint16_t, 4> codes{};
    std::memcpy(codes.data(), in, count * sizeof(std::uint16_t));
    for (std::size_t c = 0; c < count; ++c) values[c] = float_from_half(codes[c]);
  } else {
    std::memcpy(values.data(), in, count * sizeof(float));
  }
  if (count == 1) values[1] = values[2] = values[0];
  for (std::size_t c = 0; c < 3; ++c) rgb[c] = factor * values[c];
}

constexpr std::size_t pixels_per_chunk = 1 << 15;

}  // namespace

PixelLayout pixel_layout(PixelFormat format) { return facts(format).layout; }
std::string_view pixel_format_name(PixelFormat format) { return facts(format).name; }
float pixel_format_max(PixelFormat format) { return facts(format).max; }

std::optional<PixelFormat> colour_format_from_name(std::string_view name) {
  for (std::size_t i = 0; i < formats.size(); ++i)
    if (formats[i].name == name && formats[i].layout.channels >= 3) return static_cast<PixelFormat>(i);
  return std::nullopt;
}

bool pixel_format_has_sign(PixelFormat format) {
  const Component component = pixel_layout(format).component;
  return component == Component::half || component == Component::float32 ||
         component == Component::bc6h_signed;
}

// Let u = 2^(E - 24) be the unit of the mantissas for the biased exponent E. With the largest channel m in
// [2^e, 2^(e+1)), E = e + 16 puts m/u in [256, 512). A mantissa ends at 511, so for m/u above 511.5 the next
// exponent (where m rounds to 256 of its double unit) is closer; up to 511.5 this one is at least as close,
// and twice as fine for the other channels. A smaller E could not hold m within half a unit, a larger one has
// only every second of these values: so no other word brings any channel closer without moving the largest
// one away.
std::uint32_t rgb9e5_from_floats(const float rgb[3], std::size_t& clipped) {
  std::array<float, 3> value{};
  for (std::size_t c = 0; c < 3; ++c) value[c] = clamped_channel(rgb[c], rgb9e5_max, clipped);
  const float largest = std::max({value[0], value[1], value[2]});
  const int log2_floor = static_cast<int>(std::bit_cast<std::uint32_t>(largest) >> 23) - 127;
  int exponent = std::max(0, log2_floor + 16);
  if (largest * power_of_two(24 - exponent) > 511.5f) ++exponent;
  const float to_units = power_of_two(24 - exponent);
  std::uint32_t word = static_cast<std::uint32_t>(exponent) << 27;
  for (unsigned c = 0; c < 3; ++c) {
    // The unit of a float in [2^23, 2^24) is 1: the addition rounds to nearest even.
    const std::uint32_t rounded = std::bit_cast<std::uint32_t>(value[c] * to_units + 0x1p23f) & 0x3ffu;
    word |= std::min(rounded, 511u) << (9 * c);
  }
  return word;
}

void floats_from_rgb9e5(std::uint32_t word, float rgb[3]) {
  const float unit = power_of_two(static_cast<int>(word >> 27) - 24);
  for (unsigned c = 0; c < 3; ++c) rgb[c] = static_cast<float>((word >> (9 * c)) & 0x1ffu) * unit;
}

std::uint32_t r11g11b10f_from_floats(const float rgb[3], std::size_t& clipped) {
  const std::uint32_t red = small_float(clamped_channel(rgb[0], r11g11b10f_max_rg, clipped), 6);
  const std::uint32_t green = small_float(clamped_channel(rgb[1], r11g11b10f_max_rg, clipped), 6);
  const std::uint32_t blue = small_float(clamped_channel(rgb[2], r11g11b10f_max_b, clipped), 5);
  return red | (green << 11) | (blue << 22);
}

void floats_from_r11g11b10f(std::uint32_t word, float rgb[3]) {
  rgb[0] = float_from_small(word & 0x7ffu, 6);
  rgb[1] = float_from_small((word >> 11) & 0x7ffu, 6);
  rgb[2] = float_from_small(word >> 22, 5);
}

std::size_t encode_pixels(std::span<const float> pixels, int channels, float factor, PixelFormat format,
                          std::span<std::uint8_t> bytes) {
  const PixelLayout layout = pixel_layout(format);
  const std::size_t count = pixels.size() / static_cast<std::size_t>(channels);
  assert(channels >= 1 && channels <= 4 && bytes.size() == count * layout.bytes() && !layout.is_block());
  const auto clipped = parallel_partials<std::size_t>(
      count, pixels_per_chunk, [&](std::size_t& partial, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const float* pixel = pixels.data() + i * static_cast<std::size_t>(channels);
          partial += encode_pixel(gather(pixel, channels, factor), layout, bytes.data() + i * layout.bytes());
        }
      });
  return std::accumulate(clipped.begin(), clipped.end(), std::size_t{0});
}

void decode_pixels(std::span<const std::uint8_t> bytes, PixelLayout layout, float factor,
                   std::span<float> rgb) {
  const std::size_t count = rgb.size() / 3;
  assert(layout.channels <= 4 && bytes.size() == count * layout.bytes() && !layout.is_block());
  parallel_for(count, pixels_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      decode_pixel(bytes.data() + i * layout.bytes(), layout, factor, rgb.data() + 3 * i);
    }
  });
}

}  // namespace welkin
