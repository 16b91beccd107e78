#include <welkin/image/codecs/bc6h/quantise.h>

#include <algorithm>
#include <cmath>

namespace welkin::bc6h {
namespace {

int position_limit(bool is_signed) { return is_signed ? 0x7fff : 0xffff; }

int rounded_position(float position, bool is_signed) {
  const auto most = static_cast<float>(position_limit(is_signed));
  return static_cast<int>(std::lrint(std::clamp(position, is_signed ? -most : 0.0f, most)));
}

}  // namespace

// The code of a position in the middle of a cell of 2^(16 - bits) is the number of the cell, except for the first
// (0 stands for 0) and the last (the end of the scale); a position is unquantised to the middle. So start at the cell
// and step down.
int largest_code(int limit, int bits, bool is_signed) {
  const int magnitude_bits = is_signed ? bits - 1 : bits;
  const int last = (1 << magnitude_bits) - 1;
  const int position = is_signed ? ((limit + 1) * 32 - 1) / 31 : ((limit + 1) * 64 - 1) / 31;
  int code = std::min(last, position >> (16 - bits));
  while (code > 0 && half_of_position(unquantise(code, bits, is_signed), is_signed) > limit) --code;
  return code;
}

int quantise(float position, int bits, int most, bool is_signed) {
  const float magnitude = is_signed ? std::abs(position) : std::max(position, 0.0f);
  int code = 0;
  if (bits == 16) {
    code = static_cast<int>(magnitude + 0.5f);
  } else {
    const auto cell = static_cast<float>(1 << (16 - bits));
    const int last = (1 << (is_signed ? bits - 1 : bits)) - 1;
    const auto end = static_cast<float>(position_limit(is_signed));
    if (magnitude >= 0.75f * cell) {  // 0 is at 0, 1 at 1.5 cells
      code = std::max(1, static_cast<int>(std::min(magnitude, end) / cell));
      if (code >= last && magnitude <= end - 0.75f * cell) code = last - 1;
    }
    code = std::min(code, last);
  }
  code = std::min(code, most);
  return is_signed && position < 0 ? -code : code;
}

bool quantise_lines(const Targets& targets, const std::array<Line, 2>& lines, const std::array<bool, 2>& swap,
                    BlockCode& code) {
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  bool fits = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const int most = largest_code(targets.limit[c], mode.endpoint_bits, targets.is_signed);
    const int reach = 1 << (mode.delta_bits[c] - 1);
    for (std::size_t e = 0; e < static_cast<std::size_t>(2 * mode.subsets); ++e) {
      const Line& line = lines[e / 2];
      const bool take_first = (e % 2 == 0) != swap[e / 2];
      int value =
          quantise(take_first ? line.first[c] : line.second[c], mode.endpoint_bits, most, targets.is_signed);
      if (mode.transformed && e > 0) {
        const int base = code.endpoints[0][c];
        const int clamped = std::clamp(value, base - reach, base + reach - 1);
        fits = fits && clamped == value;
        value = clamped;
      }
      code.endpoints[e][c] = value;
    }
  }
  return fits;
}

Ends ends_of(const BlockCode& code, int subset, bool is_signed) {
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  const auto e = static_cast<std::size_t>(2 * subset);
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    ends.first[c] = unquantise(code.endpoints[e][c], mode.endpoint_bits, is_signed);
    ends.second[c] = unquantise(code.endpoints[e + 1][c], mode.endpoint_bits, is_signed);
  }
  return ends;
}

Ends rounded(const Line& line, bool is_signed) {
  Ends ends;
  for (std::size_t c = 0; c < 3; ++c) {
    ends.first[c] = rounded_position(line.first[c], is_signed);
    ends.second[c] = rounded_position(line.second[c], is_signed);
  }
  return ends;
}

}  // namespace welkin::bc6h
