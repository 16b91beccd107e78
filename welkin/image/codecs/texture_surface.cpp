#include <welkin/image/codecs/texture_surface.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <welkin/image/codecs/astc.h>
#include <welkin/image/codecs/bc6h/bc6h.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

using Component = PixelLayout::Component;

// Blocks go through buffers of four floats a texel, so many texels at a time.
constexpr std::size_t texels_per_strip = std::size_t{1} << 20;

// Rows of a strip: whole blocks.
int strip_rows(SurfaceShape shape, int block) {
  const std::size_t row_of_blocks = static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(block);
  return block * static_cast<int>(std::clamp<std::size_t>(texels_per_strip / row_of_blocks, 1, 1 << 20));
}

// What a block format can hold of a value, scaled.
float storable(float value, std::size_t& clipped) {
  const bool inside = value >= 0 && value <= 65504.0f;  // false for NaN
  clipped += inside ? 0 : 1;
  return inside ? std::abs(value) : (value > 0 ? 65504.0f : 0.0f);
}

// Gray repeated, missing channels 0, alpha 1.
std::size_t to_rgba(std::span<const float> pixels, int channels, float factor, std::vector<float>& rgba) {
  const auto step = static_cast<std::size_t>(channels);
  std::size_t clipped = 0;
  rgba.resize(pixels.size() / step * 4);
  for (std::size_t i = 0; i < pixels.size() / step; ++i) {
    const float* from = &pixels[i * step];
    float* to = &rgba[i * 4];
    for (std::size_t c = 0; c < 3; ++c) {
      const bool there = channels == 1 || c < step;
      to[c] = there ? storable(factor * from[channels == 1 ? 0 : c], clipped) : 0.0f;
    }
    to[3] = 1;
  }
  return clipped;
}

// What cannot be stored counts for nothing.
double mean_magnitude(std::span<const float> values, float factor) {
  const auto sums = parallel_partials<double>(values.size(), std::size_t{1} << 16,
                                              [&](double& sum, std::size_t begin, std::size_t end) {
                                                for (std::size_t i = begin; i < end; ++i) {
                                                  const float value = std::abs(values[i] * factor);
                                                  sum += value <= 65504.0f ? value : 0.0f;
                                                }
                                              });
  return std::accumulate(sums.begin(), sums.end(), 0.0) / static_cast<double>(values.size());
}

Bc6hSpeed bc6h_speed(BlockQuality quality) {
  return quality == BlockQuality::fast     ? Bc6hSpeed::fast
         : quality == BlockQuality::normal ? Bc6hSpeed::normal
                                           : Bc6hSpeed::high;
}

// encode_bc6h takes no fewer than three channels.
std::vector<float> to_rgb(std::span<const float> pixels, int channels) {
  const auto step = static_cast<std::size_t>(channels);
  std::vector<float> rgb(pixels.size() / step * 3);
  for (std::size_t i = 0; i < pixels.size() / step; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * i + c] = channels == 1 ? pixels[i] : (c < step ? pixels[i * step + c] : 0.0f);
  return rgb;
}

template <class T>
std::span<T> part_of(std::span<T> all, int index, int count) {
  const std::size_t size = all.size() / static_cast<std::size_t>(count);
  return all.subspan(static_cast<std::size_t>(index) * size, size);
}

}  // namespace

struct SurfaceEncoder::State {
  PixelFormat format;
  BlockQuality quality;
  bool shared_edges;
  PixelLayout layout;
  std::optional<AstcEncoder> astc;
  std::vector<float> rgba;

  std::size_t encode_astc(std::span<const float> texels, SurfaceShape shape, int channels, float factor,
                          std::span<std::uint8_t> bytes) {
    const int rows = strip_rows(shape, layout.block_height);
    const std::size_t row = static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(channels);
    std::size_t clipped = 0, written = 0;
    for (int y = 0; y < shape.height; y += rows) {
      const int height = std::min(rows, shape.height - y);
      const auto strip =
          texels.subspan(static_cast<std::size_t>(y) * row, static_cast<std::size_t>(height) * row);
      const std::size_t size = layout.image_bytes(shape.width, height);
      clipped += to_rgba(strip, channels, factor, rgba);
      astc->encode(rgba, shape.width, height, bytes.subspan(written, size));
      written += size;
    }
    return clipped;
  }

  // Textures hold light: what is far above the mean counts by its energy.
  Bc6hOptions bc6h_options(std::span<const float> texels, float factor) const {
    constexpr double linear_above_mean = 16;
    return {layout.component == Component::bc6h_signed, bc6h_speed(quality),
            linear_above_mean * mean_magnitude(texels, factor)};
  }

  bool is_joined_cube(SurfaceShape shape) const {
    return shared_edges && layout.is_block() && layout.component != Component::astc_hdr && shape.faces == 6 &&
           shape.width == shape.height;
  }

  std::size_t encode_cube(std::span<const float> texels, SurfaceShape shape, int channels, float factor,
                          const Bc6hOptions& options, std::span<std::uint8_t> bytes) {
    Cube cube;
    cube.size = shape.width;
    cube.texels = to_rgb(texels, channels);
    return encode_bc6h_cube(cube, factor, options, true, bytes);
  }

  std::size_t encode_face(std::span<const float> texels, SurfaceShape shape, int channels, float factor,
                          const Bc6hOptions& options, std::span<std::uint8_t> bytes) {
    if (layout.component == Component::astc_hdr) return encode_astc(texels, shape, channels, factor, bytes);
    if (channels >= 3)
      return encode_bc6h(texels, shape.width, shape.height, channels, factor, options, bytes);
    return encode_bc6h(to_rgb(texels, channels), shape.width, shape.height, 3, factor, options, bytes);
  }
};

SurfaceEncoder::SurfaceEncoder(PixelFormat format, BlockQuality quality, bool shared_edges)
    : state_(new State{format, quality, shared_edges, pixel_layout(format), {}, {}}) {
  if (state_->layout.component == Component::astc_hdr)
    state_->astc.emplace(state_->layout.block_width, quality);
}
SurfaceEncoder::~SurfaceEncoder() = default;

std::size_t SurfaceEncoder::encode(std::span<const float> texels, SurfaceShape shape, int channels,
                                   float factor, std::span<std::uint8_t> bytes) {
  assert(texels.size() == shape.pixels() * static_cast<std::size_t>(channels));
  assert(bytes.size() == shape.bytes(state_->layout));
  if (!state_->layout.is_block()) return encode_pixels(texels, channels, factor, state_->format, bytes);
  const Bc6hOptions options = state_->bc6h_options(texels, factor);
  if (state_->is_joined_cube(shape))
    return state_->encode_cube(texels, shape, channels, factor, options, bytes);
  std::size_t clipped = 0;
  for (int face = 0; face < shape.faces; ++face)
    clipped += state_->encode_face(part_of(texels, face, shape.faces), shape, channels, factor, options,
                                   part_of(bytes, face, shape.faces));
  return clipped;
}

struct SurfaceDecoder::State {
  PixelLayout layout;
  std::optional<AstcDecoder> astc;
  std::vector<float> rgba;

  void decode_astc(std::span<const std::uint8_t> bytes, SurfaceShape shape, float factor,
                   std::span<float> rgb, std::string_view name) {
    const int rows = strip_rows(shape, layout.block_height);
    std::size_t read = 0, written = 0;
    for (int y = 0; y < shape.height; y += rows) {
      const int height = std::min(rows, shape.height - y);
      const std::size_t size = layout.image_bytes(shape.width, height);
      rgba.resize(static_cast<std::size_t>(shape.width) * static_cast<std::size_t>(height) * 4);
      astc->decode(bytes.subspan(read, size), shape.width, height, rgba, name);
      for (std::size_t i = 0; i < rgba.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c) rgb[written++] = factor * rgba[i + c];
      read += size;
    }
  }

  void decode_face(std::span<const std::uint8_t> bytes, SurfaceShape shape, float factor,
                   std::span<float> rgb, std::string_view name) {
    if (layout.component == Component::astc_hdr) return decode_astc(bytes, shape, factor, rgb, name);
    decode_bc6h(bytes, shape.width, shape.height, layout.component == Component::bc6h_signed, factor, rgb);
  }
};

SurfaceDecoder::SurfaceDecoder(PixelLayout layout) : state_(new State{layout, {}, {}}) {
  if (layout.component == Component::astc_hdr) state_->astc.emplace(layout.block_width);
}
SurfaceDecoder::~SurfaceDecoder() = default;

void SurfaceDecoder::decode(std::span<const std::uint8_t> bytes, SurfaceShape shape, float factor,
                            std::span<float> rgb, std::string_view name) {
  assert(rgb.size() == 3 * shape.pixels() && bytes.size() == shape.bytes(state_->layout));
  if (!state_->layout.is_block()) return decode_pixels(bytes, state_->layout, factor, rgb);
  for (int face = 0; face < shape.faces; ++face)
    state_->decode_face(part_of(bytes, face, shape.faces), shape, factor, part_of(rgb, face, shape.faces),
                        name);
}

}  // namespace welkin
