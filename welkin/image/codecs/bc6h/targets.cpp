#include <welkin/image/codecs/bc6h/targets.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include <welkin/image/half.h>

namespace welkin::bc6h {

void round_to_halves(const float rgb[3], float factor, bool is_signed, int halves[3], std::size_t& clipped) {
  for (int i = 0; i < 3; ++i) {
    const std::uint16_t code = half_saturated(rgb[i] * factor, clipped);
    const int magnitude = code & 0x7fff;
    const bool negative = (code & 0x8000) != 0 && magnitude > 0;
    clipped += negative && !is_signed ? 1 : 0;
    halves[i] = negative ? (is_signed ? -magnitude : 0) : magnitude;
  }
}

// A half h comes from all positions i with floor(31 i / 64) = h (signed: 31 |i| / 32), which are ceil(64 h / 31) to
// ceil(64 (h + 1) / 31) - 1: their middle is the target.
Targets make_targets(const int halves[48], const float importance[16], bool is_signed, const float* scale) {
  const int whole = is_signed ? 32 : 64;  // 31 halves take so many positions
  Targets targets{};
  targets.is_signed = is_signed;
  targets.scale = scale;
  targets.importance = load(importance);
  for (std::size_t c = 0; c < 3; ++c) {
    float level[16], position[16], weight[16];
    for (int t = 0; t < 16; ++t) {
      const int half = halves[3 * t + static_cast<int>(c)];
      const int magnitude = std::abs(half);
      const float slope = (scale[magnitude + 1] - scale[magnitude]) * (31.0f / static_cast<float>(whole));
      const int low = (whole * magnitude + 30) / 31, high = (whole * (magnitude + 1) + 30) / 31 - 1;
      const float middle = 0.5f * static_cast<float>(low + high);
      level[t] = scale[half];
      position[t] = half < 0 ? -middle : middle;
      weight[t] = importance[t] * slope * slope;
      targets.limit[c] = std::max(targets.limit[c], magnitude);
    }
    targets.level[c] = load(level), targets.position[c] = load(position), targets.weight[c] = load(weight);
  }
  return targets;
}

}  // namespace welkin::bc6h
