#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

// IEEE 754 binary16 ("half"): 1 sign bit, 5 exponent bits (bias 15), 10 mantissa bits. Largest finite value
// 65504, smallest normal 2^-14 = 6.1e-5, smallest subnormal 2^-24 = 6e-8.

namespace welkin {

inline constexpr float half_max = 65504.0f;

/// The half nearest to `value`, ties to even; beyond 65520 it is infinity, NaN stays NaN (quiet).
std::uint16_t half_from_float(float value);

/// The exact value of a half.
float float_from_half(std::uint16_t code);

/// half_from_float for pixels: what lies beyond +-65504 (infinity too) becomes +-65504 and NaN becomes 0, and
/// each of them adds one to `clipped`.
std::uint16_t half_saturated(float value, std::size_t& clipped);

/// half_saturated of every element; both spans have the same size. Returns how many values were clipped.
std::size_t halves_from_floats(std::span<const float> values, std::span<std::uint16_t> codes);

/// float_from_half of every element; both spans have the same size.
void floats_from_halves(std::span<const std::uint16_t> codes, std::span<float> values);

}  // namespace welkin
