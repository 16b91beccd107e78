#include <welkin/image/half.h>

#include <bit>
#include <cassert>

namespace welkin {
namespace {

constexpr std::uint32_t sign_bit = 0x80000000u;
constexpr std::uint32_t float_infinity = 0x7f800000u;
constexpr std::uint32_t smallest_normal = 0x38800000u;     // 2^-14
constexpr std::uint32_t rounds_to_infinity = 0x477ff000u;  // 65520, half way between 65504 and 65536
constexpr std::uint32_t largest_half = 0x477fe000u;        // 65504
constexpr std::uint32_t exponent_rebias = 112u << 23;      // 127 - 15

// The code of a non-negative finite value below 65520, given by its bits.
// Normal: drop 13 mantissa bits after adding just under half of the dropped unit, plus the kept lowest bit,
// so that a tie goes to even; a carry runs into the exponent as it should. Subnormal: half's unit 2^-24 is
// also float's unit in [1/2, 1), so adding 1/2 lets the FPU (in its default mode, to nearest even) round for
// us.
std::uint16_t magnitude_code(std::uint32_t magnitude) {
  const std::uint32_t normal = (magnitude + 0xfffu + ((magnitude >> 13) & 1u) - exponent_rebias) >> 13;
  const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) -
                                  std::bit_cast<std::uint32_t>(0.5f);
  return static_cast<std::uint16_t>(magnitude < smallest_normal ? subnormal : normal);
}

std::uint16_t saturated_code(float value, std::uint32_t& clipped) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t magnitude = bits & ~sign_bit;
  const bool nan = magnitude > float_infinity;
  const bool beyond = magnitude > largest_half;
  clipped += beyond ? 1u : 0u;
  const std::uint16_t code = magnitude_code(beyond ? largest_half : magnitude);
  return nan ? std::uint16_t{0} : static_cast<std::uint16_t>(code | ((bits & sign_bit) >> 16));
}

}  // namespace

std::uint16_t half_from_float(float value) {
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t magnitude = bits & ~sign_bit;
  const auto sign = static_cast<std::uint16_t>((bits & sign_bit) >> 16);
  if (magnitude > float_infinity) return sign | 0x7e00u;
  if (magnitude >= rounds_to_infinity) return sign | 0x7c00u;
  return sign | magnitude_code(magnitude);
}

// The exponent and mantissa fields move to float's place and the exponent is rebiased. The field 31
// (infinity, NaN) needs the rebias twice; the field 0 (subnormal) becomes 2^-14 (1 + m), from which 2^-14 is
// taken off exactly.
float float_from_half(std::uint16_t code) {
  const std::uint32_t sign = (code & 0x8000u) << 16;
  const std::uint32_t shifted = (code & 0x7fffu) << 13;
  const std::uint32_t exponent = shifted & 0x0f800000u;
  const std::uint32_t normal = shifted + exponent_rebias + (exponent == 0x0f800000u ? exponent_rebias : 0u);
  const float subnormal =
      std::bit_cast<float>(shifted + smallest_normal) - std::bit_cast<float>(smallest_normal);
  const std::uint32_t magnitude = exponent == 0 ? std::bit_cast<std::uint32_t>(subnormal) : normal;
  return std::bit_cast<float>(sign | magnitude);
}

std::uint16_t half_saturated(float value, std::size_t& clipped) {
  std::uint32_t one = 0;
  const std::uint16_t code = saturated_code(value, one);
  clipped += one;
  return code;
}

std::size_t halves_from_floats(std::span<const float> values, std::span<std::uint16_t> codes) {
  assert(values.size() == codes.size());
  constexpr std::size_t block = 4096;  // 32-bit counters inside, so that the compiler can use SIMD
  std::size_t clipped = 0;
  for (std::size_t begin = 0; begin < values.size(); begin += block) {
    const std::size_t end = begin + block < values.size() ? begin + block : values.size();
    std::uint32_t in_block = 0;
    for (std::size_t i = begin; i < end; ++i) codes[i] = saturated_code(values[i], in_block);
    clipped += in_block;
  }
  return clipped;
}

void floats_from_halves(std::span<const std::uint16_t> codes, std::span<float> values) {
  assert(values.size() == codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) values[i] = float_from_half(codes[i]);
}

}  // namespace welkin
