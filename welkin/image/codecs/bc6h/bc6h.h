#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <welkin/image/image.h>

// BC6H (BPTC float): 4 x 4 texels of three half floats in 16 bytes, 1 byte a texel, as Khronos Data Format
// Specification 1.3, section 20.2, and Direct3D 11 define it. Encoder and decoder are welkin's own.

namespace welkin {

/// How long the encoder may search. fast: one pass of least squares, two partitions. normal: more partitions and
/// refinement. high: all 14 modes and all 32 partitions.
enum class Bc6hSpeed { fast, normal, high };

struct Bc6hOptions {
  bool is_signed = false;  ///< SF16 instead of UF16: negative values are kept
  Bc6hSpeed speed = Bc6hSpeed::normal;
  /// Values (after `factor`) far above this count by their difference instead of by their ratio, so that lamps keep
  /// their energy; 0: never. See error_scale.h. 16 times the mean is a good choice for light.
  double linear_above = 0;
};

using Bc6hBlock = std::array<std::uint8_t, 16>;

/// The 16 texels of a block as half-float codes, r g b, row by row from the top: exactly what the specification
/// says, so what every GPU returns. The four reserved modes give black. Any 16 bytes decode; a signed block can hold
/// the code 0xfc00 (-infinity), which this encoder never writes.
void decode_bc6h_block(const Bc6hBlock& block, bool is_signed, std::uint16_t halves[48]);

/// The block for 16 texels of r g b, row by row. Values are rounded to halves as half_saturated does (65504 at most,
/// NaN becomes 0; negative becomes 0 when unsigned) and each that does not fit adds one to `clipped`. What comes
/// back after decoding is never brighter than the block: no channel's magnitude exceeds the largest of that channel
/// (as a half) in the block. The search minimises the sum of squared differences of log(1 + x), see error_scale.h.
Bc6hBlock encode_bc6h_block(const float rgb[48], const Bc6hOptions& options, std::size_t& clipped);

/// Bytes of an image: 16 for each block of 4 x 4 texels, blocks at the right and lower end may be partly outside.
std::size_t bc6h_bytes(int width, int height);

/// Encodes width x height texels of `channels` (3 or 4; the fourth is dropped) floats, row by row, each multiplied
/// by `factor` first (a power of two). Blocks lie row by row; texels beyond the border repeat the last one. out.size()
/// == bc6h_bytes(width, height). Returns how many values were clipped. Runs on all threads; the bytes do not depend
/// on their number.
std::size_t encode_bc6h(std::span<const float> pixels, int width, int height, int channels, float factor,
                        const Bc6hOptions& options, std::span<std::uint8_t> out);

/// Encodes the six faces of a cube (channels 3 or 4) as encode_bc6h does, one after the other in `out`, which has 6
/// bc6h_bytes(size, size) elements. With shared_edges, texels on either side of an edge between faces decode to the same
/// values, for samplers that do not filter across faces: the input should hold equal texels there (edge fix-up); where
/// they differ, both become the mean. The blocks along an edge then take partitions that split off their edge, and both
/// faces code it with the same ends and indices: exactly equal. The blocks in the corners, and every block where
/// size is not a multiple of 4 or is below 12, cannot be split so: they are coded in turns towards each other, and
/// nearly equal. Returns how many values were clipped.
std::size_t encode_bc6h_cube(const Cube& cube, float factor, const Bc6hOptions& options, bool shared_edges,
                             std::span<std::uint8_t> out);

/// The reverse, into three floats a texel, each multiplied by `factor`. blocks.size() == bc6h_bytes(width, height),
/// rgb.size() == 3 * width * height. Runs on all threads.
void decode_bc6h(std::span<const std::uint8_t> blocks, int width, int height, bool is_signed, float factor,
                 std::span<float> rgb);

}  // namespace welkin
