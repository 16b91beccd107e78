#include <welkin/sampling/sequence.h>

#include <cassert>

namespace welkin {
namespace {

// 2^64 / g and 2^64 / g^2 with g = 1.32471795724474602596, rounded: multiples modulo 1 are exact in wrapping
// 64-bit arithmetic however large the index is, where doubles would lose digits.
constexpr std::uint64_t r2_step_x = 0xC13FA9A902A6328FULL;
constexpr std::uint64_t r2_step_y = 0x91E10DA5C79E7B1DULL;

// The top 53 bits as a double in [0, 1).
double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace

std::uint64_t mix_bits(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

Point2 r2_point(std::uint64_t index, std::uint64_t seed) {
  constexpr std::uint64_t half = std::uint64_t{1} << 63;
  const std::uint64_t shift_x = seed == 0 ? half : mix_bits(2 * seed);
  const std::uint64_t shift_y = seed == 0 ? half : mix_bits(2 * seed + 1);
  return {unit_interval(shift_x + index * r2_step_x), unit_interval(shift_y + index * r2_step_y)};
}

double radical_inverse_base2(std::uint64_t index) {
  std::uint64_t mirrored = 0;
  for (int bit = 0; bit < 64; ++bit) mirrored |= ((index >> bit) & 1) << (63 - bit);
  return unit_interval(mirrored);
}

Point2 hammersley_point(std::uint64_t index, std::uint64_t count) {
  assert(index < count);
  return {static_cast<double>(index) / static_cast<double>(count), radical_inverse_base2(index)};
}

}  // namespace welkin
