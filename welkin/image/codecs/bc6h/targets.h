#pragma once
#include <array>
#include <cstddef>

#include <welkin/image/codecs/bc6h/lanes.h>

namespace welkin::bc6h {

/// What a block should decode to, one lane a texel.
struct Targets {
  std::array<Lanes, 3> level;     // on the error scale
  std::array<Lanes, 3> position;  // on the 16-bit scale where colours are interpolated
  std::array<Lanes, 3> weight;    // importance times (d level / d position)^2: the error of a small miss
  Lanes importance;               // 1, more for texels whose error counts more
  std::array<int, 3> limit;  // the largest magnitude of each channel, as a half: nothing may decode above it
  const float* scale = nullptr;  // ErrorScale::values()
  bool is_signed = false;
};

inline constexpr float equal_importance[16] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

/// From 16 texels of halves as sign and magnitude in one integer (no infinities), r g b.
/// scale: ErrorScale::values(), must outlive the result.
Targets make_targets(const int halves[48], const float importance[16], bool is_signed, const float* scale);

/// One texel times `factor` as halves, sign and magnitude in one integer, after saturation; adds to `clipped` how many
/// channels did not fit.
void round_to_halves(const float rgb[3], float factor, bool is_signed, int halves[3], std::size_t& clipped);

}  // namespace welkin::bc6h
