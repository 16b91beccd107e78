#pragma once
#include <array>
#include <cstdint>
#include <span>

#include <welkin/geometry/vec3f.h>

// Sobol's points with Owen's scrambling (Owen 1995), by hashing (Laine & Karras 2011; Burley 2020, "Practical hash-based
// Owen scrambling"), and padded: every pair of dimensions is the first pair of Sobol's sequence (a (0, 2)-sequence: each
// aligned block of 2^k points has one point in every elementary interval of area 2^-k), shuffled and scrambled
// independently of all other pairs. Averages over n points of a smooth integrand converge like n^-1.5.

namespace welkin {

constexpr std::uint32_t reversed_bits(std::uint32_t v) {
  v = (v >> 16) | (v << 16);
  v = ((v & 0xff00ff00u) >> 8) | ((v & 0x00ff00ffu) << 8);
  v = ((v & 0xf0f0f0f0u) >> 4) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v & 0xccccccccu) >> 2) | ((v & 0x33333333u) << 2);
  return ((v & 0xaaaaaaaau) >> 1) | ((v & 0x55555555u) << 1);
}

/// Bits in reversed order, scrambled so that each depends only on those below it: Owen's nested uniform scrambling of the
/// number whose leading digit is bit 0 (Laine & Karras 2011, section 3.3). A bijection for every seed.
constexpr std::uint32_t scrambled_reversed(std::uint32_t v, std::uint32_t seed) {
  v += seed;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return v;
}

/// Owen's scrambling of a number whose leading digit is bit 31.
constexpr std::uint32_t owen_scrambled(std::uint32_t v, std::uint32_t seed) {
  return reversed_bits(scrambled_reversed(reversed_bits(v), seed));
}

/// Sobol's second dimension of point `index` with its bits reversed: the direction numbers are Pascal's triangle modulo
/// 2, whose 32 x 32 matrix is a Kronecker product of five 2 x 2 ones, one step each.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) {
  index ^= (index & 0xaaaaaaaau) >> 1;
  index ^= (index & 0xccccccccu) >> 2;
  index ^= (index & 0xf0f0f0f0u) >> 4;
  index ^= (index & 0xff00ff00u) >> 8;
  index ^= (index & 0xffff0000u) >> 16;
  return index;
}

/// A float in [0, 1) from the upper 24 of 32 bits.
constexpr float unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

/// Mixes 32 bits well enough for seeds: a bijection (Wellons' lowbias32).
constexpr std::uint32_t mix_bits32(std::uint32_t v) {
  v = (v ^ (v >> 16)) * 0x7feb352du;
  v = (v ^ (v >> 15)) * 0x846ca68bu;
  return v ^ (v >> 16);
}

/// The numbers of one sample of one pixel, handed out in the order of calls. Samples 0, 1, 2, ... of the same seed are
/// stratified against each other dimension by dimension, so calls have to come in the same order in all of them.
class SampleStream {
 public:
  SampleStream() : SampleStream(0, 0) {}
  /// seed: of the pixel and the picture. Streams of different seeds are independent.
  SampleStream(std::uint32_t sample_index, std::uint32_t seed)
      : reversed_index_(reversed_bits(sample_index)), seed_(seed) {}

  /// Uniform in [0, 1)^2.
  Vec2f next_2d() {
    const std::uint32_t seed = mix_bits32(next_seed());
    const std::uint32_t shuffled = reversed_bits(scrambled_reversed(reversed_index_, seed));
    const std::uint32_t x = scrambled_reversed(shuffled, mix_bits32(seed ^ 0x55555555u));
    const std::uint32_t y =
        scrambled_reversed(sobol_second_reversed(shuffled), mix_bits32(seed ^ 0xaaaaaaaau));
    return {unit_float(reversed_bits(x)), unit_float(reversed_bits(y))};
  }
  /// Uniform in [0, 1).
  float next_1d() {
    const std::uint32_t seed = mix_bits32(next_seed());
    const std::uint32_t shuffled = reversed_bits(scrambled_reversed(reversed_index_, seed));
    return unit_float(reversed_bits(scrambled_reversed(shuffled, mix_bits32(seed ^ 0x55555555u))));
  }

  /// next_2d of each into numbers; what a batch of samples needs is made together, several times as fast.
  friend void next_2d(std::span<SampleStream* const> streams, Vec2f* numbers);

 private:
  std::uint32_t next_seed() { return seed_ + 0x9e3779b9u * ++dimension_; }

  std::uint32_t reversed_index_ = 0, seed_ = 0, dimension_ = 0;
};

void next_2d(std::span<SampleStream* const> streams, Vec2f* numbers);

}  // namespace welkin
