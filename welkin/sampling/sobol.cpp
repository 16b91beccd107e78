#include <welkin/sampling/sobol.h>

#include <algorithm>

#include <welkin/parallel/target_clones.h>

namespace welkin {
namespace {

constexpr std::size_t lanes = 16;

struct Lanes {
  std::uint32_t reversed_index[lanes] = {}, seed[lanes] = {};
  float x[lanes], y[lanes];
};

// All lanes, used or not: integers, so every instruction set gives the same.
WELKIN_TARGET_CLONES void fill(Lanes& all) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const std::uint32_t seed = mix_bits32(all.seed[i]);
    const std::uint32_t shuffled = reversed_bits(scrambled_reversed(all.reversed_index[i], seed));
    const std::uint32_t x = scrambled_reversed(shuffled, mix_bits32(seed ^ 0x55555555u));
    const std::uint32_t y =
        scrambled_reversed(sobol_second_reversed(shuffled), mix_bits32(seed ^ 0xaaaaaaaau));
    all.x[i] = static_cast<float>(static_cast<std::int32_t>(reversed_bits(x) >> 8)) * 0x1p-24f;
    all.y[i] = static_cast<float>(static_cast<std::int32_t>(reversed_bits(y) >> 8)) * 0x1p-24f;
  }
}

}  // namespace

void next_2d(std::span<SampleStream* const> streams, Vec2f* numbers) {
  for (std::size_t begin = 0; begin < streams.size(); begin += lanes) {
    const std::size_t count = std::min(lanes, streams.size() - begin);
    Lanes all;
    for (std::size_t i = 0; i < count; ++i) {
      SampleStream& stream = *streams[begin + i];
      all.reversed_index[i] = stream.reversed_index_;
      all.seed[i] = stream.next_seed();
    }
    fill(all);
    for (std::size_t i = 0; i < count; ++i) numbers[begin + i] = {all.x[i], all.y[i]};
  }
}

}  // namespace welkin
