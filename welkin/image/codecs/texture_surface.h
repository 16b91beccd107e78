#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <welkin/image/codecs/block_quality.h>
#include <welkin/image/packed_formats.h>

// Whole images in any PixelFormat, of pixels or of blocks: what the texture containers have in common.

namespace welkin {

/// `faces` images of width x height, one after the other. Each begins its own blocks; rows and columns that blocks have
/// beyond an image repeat its last ones.
struct SurfaceShape {
  int width = 0, height = 0, faces = 1;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height * faces; }
  std::size_t bytes(PixelLayout layout) const { return layout.image_bytes(width, height) * faces; }
};

/// Writes levels of one texture. It uses all threads itself: two threads may not call the same object at once.
class SurfaceEncoder {
 public:
  /// shared_edges: six square faces are a cube that holds equal texels on either side of every edge (edge fix-up);
  /// BC6H keeps them equal after decoding, but for the blocks in corners and small levels (see encode_bc6h_cube). ASTC
  /// does not.
  explicit SurfaceEncoder(PixelFormat format, BlockQuality quality = BlockQuality::normal,
                          bool shared_edges = false);
  ~SurfaceEncoder();
  SurfaceEncoder(const SurfaceEncoder&) = delete;
  SurfaceEncoder& operator=(const SurfaceEncoder&) = delete;

  /// As encode_pixels, which it is for formats of pixels. texels.size() == shape.pixels() * channels, bytes.size() ==
  /// shape.bytes(layout). For blocks, too, values are multiplied by `factor`, then saturated, then counted where that
  /// changed them (values, not what the compression loses); no decoded value is brighter than the brightest channel in
  /// its block, but for 1 %. The same bytes on any number of threads.
  std::size_t encode(std::span<const float> texels, SurfaceShape shape, int channels, float factor,
                     std::span<std::uint8_t> bytes);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Reads levels of one texture.
class SurfaceDecoder {
 public:
  explicit SurfaceDecoder(PixelLayout layout);
  ~SurfaceDecoder();
  SurfaceDecoder(const SurfaceDecoder&) = delete;
  SurfaceDecoder& operator=(const SurfaceDecoder&) = delete;

  /// As decode_pixels. rgb.size() == 3 * shape.pixels(), bytes.size() == shape.bytes(layout). Throws Error(name, ...)
  /// for blocks that are not valid.
  void decode(std::span<const std::uint8_t> bytes, SurfaceShape shape, float factor, std::span<float> rgb,
              std::string_view name);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin
