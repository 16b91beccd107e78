#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <welkin/image/codecs/block_quality.h>

// ASTC HDR (Nystad et al. 2012; Khronos Data Format Specification 1.3, chapter 23) by Arm's astcenc: blocks of 16 bytes
// for 4 x 4 or 6 x 6 texels, three channels without a sign, which decode to half floats.

namespace welkin {

/// Encodes images of one block size and quality with what astcenc allocates once. It uses all threads itself: two
/// threads may not call the same object at once.
class AstcEncoder {
 public:
  /// block: 4 or 6. The qualities are astcenc's presets fast, medium and thorough. Throws Error where astcenc refuses.
  AstcEncoder(int block, BlockQuality quality);
  ~AstcEncoder();
  AstcEncoder(const AstcEncoder&) = delete;
  AstcEncoder& operator=(const AstcEncoder&) = delete;

  /// rgba: 4 floats a texel, finite, in [0, 65504], alpha 1. blocks: 16 bytes a block, row by row; sides that are no
  /// multiple of the block are continued by their last texel. No decoded value is above 1.01 times the brightest
  /// channel of the texels in its block: astcenc alone, which weighs errors by their logarithm, can be off by a factor
  /// of 13 where one texel is far brighter than its neighbours; such blocks are encoded again with their bright texels
  /// lowered, and as one colour where that does not help. The same bytes on any number of threads.
  void encode(std::span<const float> rgba, int width, int height, std::span<std::uint8_t> blocks);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Decodes images of one block size.
class AstcDecoder {
 public:
  /// block: 4 or 6.
  explicit AstcDecoder(int block);
  ~AstcDecoder();
  AstcDecoder(const AstcDecoder&) = delete;
  AstcDecoder& operator=(const AstcDecoder&) = delete;

  /// The layout of AstcEncoder::encode. Throws Error(name, ...) for blocks that are no valid HDR blocks (they decode to
  /// NaN).
  void decode(std::span<const std::uint8_t> blocks, int width, int height, std::span<float> rgba,
              std::string_view name);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace welkin
