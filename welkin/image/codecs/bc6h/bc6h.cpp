#include <welkin/image/codecs/bc6h/bc6h.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>

#include <welkin/image/codecs/bc6h/encode_block.h>
#include <welkin/image/codecs/bc6h/error_scale.h>
#include <welkin/image/half.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

std::size_t blocks_of(int texels) { return (static_cast<std::size_t>(texels) + 3) / 4; }

Bc6hBlock encode_halves(const int halves[48], const Bc6hOptions& options, const bc6h::ErrorScale& scale) {
  return bc6h::pack(bc6h::encode(halves, options, scale).code);
}

struct Pixels {
  std::span<const float> values;
  int width, height, channels;
  float factor;
};

// One block; texels beyond the border repeat the last, and are not counted as clipped.
void gather(const Pixels& image, int block_x, int block_y, bool is_signed, int halves[48],
            std::size_t& clipped) {
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const int from_x = std::min(4 * block_x + x, image.width - 1);
      const int from_y = std::min(4 * block_y + y, image.height - 1);
      const bool inside = from_x == 4 * block_x + x && from_y == 4 * block_y + y;
      const float* pixel =
          image.values.data() + (static_cast<std::size_t>(from_y) * image.width + from_x) * image.channels;
      std::size_t here = 0;
      bc6h::round_to_halves(pixel, image.factor, is_signed, halves + 3 * (4 * y + x), here);
      clipped += inside ? here : 0;
    }
  }
}

}  // namespace

Bc6hBlock encode_bc6h_block(const float rgb[48], const Bc6hOptions& options, std::size_t& clipped) {
  int halves[48];
  for (int t = 0; t < 16; ++t)
    bc6h::round_to_halves(rgb + 3 * t, 1, options.is_signed, halves + 3 * t, clipped);
  return encode_halves(halves, options, *bc6h::error_scale(options.linear_above));
}

std::size_t bc6h_bytes(int width, int height) { return 16 * blocks_of(width) * blocks_of(height); }

std::size_t encode_bc6h(std::span<const float> pixels, int width, int height, int channels, float factor,
                        const Bc6hOptions& options, std::span<std::uint8_t> out) {
  assert(channels == 3 || channels == 4);
  assert(pixels.size() == static_cast<std::size_t>(width) * height * channels);
  assert(out.size() == bc6h_bytes(width, height));
  const Pixels image{pixels, width, height, channels, factor};
  const std::size_t across = blocks_of(width);
  const auto scale = bc6h::error_scale(options.linear_above);
  const auto clipped = parallel_partials<std::size_t>(
      blocks_of(height), 1, [&](std::size_t& partial, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin * across; i < end * across; ++i) {
          int halves[48];
          gather(image, static_cast<int>(i % across), static_cast<int>(i / across), options.is_signed, halves,
                 partial);
          const Bc6hBlock block = encode_halves(halves, options, *scale);
          std::memcpy(out.data() + 16 * i, block.data(), 16);
        }
      });
  return std::accumulate(clipped.begin(), clipped.end(), std::size_t{0});
}

void decode_bc6h(std::span<const std::uint8_t> blocks, int width, int height, bool is_signed, float factor,
                 std::span<float> rgb) {
  assert(blocks.size() == bc6h_bytes(width, height));
  assert(rgb.size() == static_cast<std::size_t>(width) * height * 3);
  const std::size_t across = blocks_of(width);
  parallel_for(blocks_of(height), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * across; i < end * across; ++i) {
      Bc6hBlock block;
      std::memcpy(block.data(), blocks.data() + 16 * i, 16);
      std::uint16_t halves[48];
      decode_bc6h_block(block, is_signed, halves);
      const int x0 = 4 * static_cast<int>(i % across), y0 = 4 * static_cast<int>(i / across);
      for (int y = y0; y < std::min(y0 + 4, height); ++y) {
        for (int x = x0; x < std::min(x0 + 4, width); ++x) {
          float* pixel = rgb.data() + (static_cast<std::size_t>(y) * width + x) * 3;
          for (int c = 0; c < 3; ++c)
            pixel[c] = factor * float_from_half(halves[3 * (4 * (y - y0) + x - x0) + c]);
        }
      }
    }
  });
}

}  // namespace welkin
