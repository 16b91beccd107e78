#include <welkin/image/codecs/ktx2_format.h>

#include <bit>
#include <numeric>

namespace welkin {
namespace {

using Component = PixelLayout::Component;

// Those of PixelFormat come first, in its order.
constexpr std::array<Ktx2Format, 13> formats = {{
    {97, 2, {Component::half, 4}, "RGBA16F"},
    {109, 4, {Component::float32, 4}, "RGBA32F"},
    {123, 4, {Component::shared_exponent, 3}, "E5B9G9R9"},
    {83, 2, {Component::half, 2}, "RG16F"},
    {103, 4, {Component::float32, 2}, "RG32F"},
    {122, 4, {Component::small_floats, 3}, "B10G11R11F"},
    {143, 1, {Component::bc6h_unsigned, 3, 4, 4}, "BC6H"},
    {144, 1, {Component::bc6h_signed, 3, 4, 4}, "BC6H signed"},
    {1000066000, 1, {Component::astc_hdr, 3, 4, 4}, "ASTC HDR 4x4"},
    {1000066004, 1, {Component::astc_hdr, 3, 6, 6}, "ASTC HDR 6x6"},
    {90, 2, {Component::half, 3}, "RGB16F"},
    {106, 4, {Component::float32, 3}, "RGB32F"},
    {100, 4, {Component::float32, 1}, "R32F"},
}};

constexpr std::uint32_t model_rgbsda = 1, model_bc6h = 133, model_astc = 162;
constexpr std::uint32_t primaries_bt709 = 1, transfer_linear = 1;
constexpr std::uint32_t block_version = 2, block_header_bytes = 24, sample_bytes = 16;
constexpr std::uint32_t qualifier_exponent = 0x20, qualifier_signed = 0x40, qualifier_float = 0x80;
constexpr std::array<std::uint32_t, 4> channel_ids = {0, 1, 2, 15};  // red, green, blue, alpha

struct Sample {
  std::uint32_t bit_offset, bit_length, channel, lower, upper;
};

// Each float channel is one sample whose nominal range is -1 to 1.
std::vector<Sample> float_samples(PixelLayout layout) {
  const std::uint32_t bits = layout.component == Component::half ? 16 : 32;
  std::vector<Sample> samples;
  for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(layout.channels); ++c) {
    samples.push_back({c * bits, bits, channel_ids[c] | qualifier_signed | qualifier_float,
                       std::bit_cast<std::uint32_t>(-1.0f), std::bit_cast<std::uint32_t>(1.0f)});
  }
  return samples;
}

// Each channel is its 9 mantissa bits followed by the exponent bits that all three share. For a mantissa, the
// specification's own example gives 8448 as the upper end; for an exponent, lower is the bias and upper the
// largest.
std::vector<Sample> shared_exponent_samples() {
  std::vector<Sample> samples;
  for (std::uint32_t c = 0; c < 3; ++c) {
    samples.push_back({9 * c, 9, channel_ids[c], 0, 8448});
    samples.push_back({27, 5, channel_ids[c] | qualifier_exponent, 15, 31});
  }
  return samples;
}

// Three unsigned floats of 11, 11 and 10 bits; the nominal range is 0 to 1.
std::vector<Sample> small_float_samples() {
  std::vector<Sample> samples;
  for (std::uint32_t c = 0; c < 3; ++c)
    samples.push_back(
        {11 * c, c < 2 ? 11u : 10u, channel_ids[c] | qualifier_float, 0, std::bit_cast<std::uint32_t>(1.0f)});
  return samples;
}

// A whole block is one sample of channel 0. Signed formats and ASTC HDR (whose format is called SFLOAT) range from -1.
std::vector<Sample> block_samples(PixelLayout layout) {
  const bool has_sign = layout.component != Component::bc6h_unsigned;
  const std::uint32_t lower = has_sign ? std::bit_cast<std::uint32_t>(-1.0f) : 0;
  return {{0, 128, qualifier_float | (has_sign ? qualifier_signed : 0), lower,
           std::bit_cast<std::uint32_t>(1.0f)}};
}

std::vector<Sample> samples_of(PixelLayout layout) {
  if (layout.is_block()) return block_samples(layout);
  if (layout.component == Component::shared_exponent) return shared_exponent_samples();
  return layout.component == Component::small_floats ? small_float_samples() : float_samples(layout);
}

std::uint32_t colour_model(PixelLayout layout) {
  if (!layout.is_block()) return model_rgbsda;
  return layout.component == Component::astc_hdr ? model_astc : model_bc6h;
}

// Texel block dimensions less one, one a byte.
std::uint32_t block_dimensions(PixelLayout layout) {
  return static_cast<std::uint32_t>(layout.block_width - 1) |
         (static_cast<std::uint32_t>(layout.block_height - 1) << 8);
}

}  // namespace

const Ktx2Format& ktx2_format(PixelFormat format) { return formats.at(static_cast<std::size_t>(format)); }

const Ktx2Format& ktx2_float_format(int channels) {
  constexpr std::array<std::uint32_t, 4> numbers = {100, 103, 106, 109};
  return *find_ktx2_format(numbers.at(static_cast<std::size_t>(channels - 1)));
}

const Ktx2Format* find_ktx2_format(std::uint32_t vk_format) {
  for (const Ktx2Format& format : formats) {
    if (format.vk_format == vk_format) return &format;
  }
  return nullptr;
}

std::size_t ktx2_level_alignment(PixelLayout layout, bool supercompressed) {
  return supercompressed ? 1 : std::lcm(layout.bytes(), std::size_t{4});
}

std::vector<std::uint32_t> ktx2_data_format_descriptor(PixelLayout layout) {
  const std::vector<Sample> samples = samples_of(layout);
  const auto block_bytes = static_cast<std::uint32_t>(block_header_bytes + sample_bytes * samples.size());
  std::vector<std::uint32_t> words = {
      4 + block_bytes,  // dfdTotalSize
      0,                // vendor Khronos, basic descriptor
      block_version | (block_bytes << 16),
      colour_model(layout) | (primaries_bt709 << 8) | (transfer_linear << 16),  // flags 0: alpha is straight
      block_dimensions(layout),
      static_cast<std::uint32_t>(layout.bytes()),  // bytesPlane0; one plane only
      0,
  };
  for (const Sample& sample : samples) {
    words.push_back(sample.bit_offset | ((sample.bit_length - 1) << 16) | (sample.channel << 24));
    words.push_back(0);  // sample position
    words.push_back(sample.lower);
    words.push_back(sample.upper);
  }
  return words;
}

}  // namespace welkin
