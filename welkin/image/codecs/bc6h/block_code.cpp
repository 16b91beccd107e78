#include <welkin/image/codecs/bc6h/block_code.h>

#include <algorithm>
#include <cassert>

namespace welkin::bc6h {
namespace {

// The 128 bits of a block, lowest first.
class BitReader {
 public:
  explicit BitReader(const Bc6hBlock& block) {
    for (std::size_t i = 0; i < 8; ++i) {
      low_ |= static_cast<std::uint64_t>(block[i]) << (8 * i);
      high_ |= static_cast<std::uint64_t>(block[i + 8]) << (8 * i);
    }
  }
  int take(int count) {
    const int value = static_cast<int>(low_ & ((std::uint64_t{1} << count) - 1));
    low_ = (low_ >> count) | (high_ << (64 - count));
    high_ >>= count;
    return value;
  }

 private:
  std::uint64_t low_ = 0, high_ = 0;
};

class BitWriter {
 public:
  void put(unsigned value, int count) {
    const std::uint64_t bits = value & ((1u << count) - 1);
    if (used_ < 64) {
      low_ |= bits << used_;
      if (used_ + count > 64) high_ |= bits >> (64 - used_);
    } else {
      high_ |= bits << (used_ - 64);
    }
    used_ += count;
  }
  Bc6hBlock block() const {
    assert(used_ == 128);
    Bc6hBlock bytes{};
    for (std::size_t i = 0; i < 8; ++i) {
      bytes[i] = static_cast<std::uint8_t>(low_ >> (8 * i));
      bytes[i + 8] = static_cast<std::uint8_t>(high_ >> (8 * i));
    }
    return bytes;
  }

 private:
  std::uint64_t low_ = 0, high_ = 0;
  int used_ = 0;
};

int sign_extended(int value, int bits) {
  const int sign = 1 << (bits - 1);
  return (value & (2 * sign - 1) & ~sign) - (value & sign);
}

int mode_place(int number, int bits) {
  for (int i = 0; i < mode_count; ++i) {
    const Mode& mode = modes[static_cast<std::size_t>(i)];
    if (mode.number == number && mode.number_bits == bits) return i;
  }
  return -1;
}

// Offsets become codes: both are two's complement; the sum wraps at endpoint_bits.
void resolve_endpoints(const Mode& mode, bool is_signed, BlockCode& code) {
  const int mask = (1 << mode.endpoint_bits) - 1;
  for (std::size_t e = 0; e < 4; ++e) {
    for (std::size_t c = 0; c < 3; ++c) {
      int& value = code.endpoints[e][c];
      if (mode.transformed && e > 0) {
        value = (code.endpoints[0][c] + sign_extended(value, mode.delta_bits[c])) & mask;
      }
      if (is_signed) value = sign_extended(value, mode.endpoint_bits);
    }
  }
}

bool is_anchor(const BlockCode& code, const Mode& mode, int texel) {
  return texel == 0 || (mode.subsets == 2 && texel == anchor_of(code, 1));
}

}  // namespace

bool unpack(const Bc6hBlock& block, bool is_signed, BlockCode& code) {
  BitReader bits(block);
  int number = bits.take(2);
  const int number_bits = number < 2 ? 2 : 5;
  if (number_bits == 5) number |= bits.take(3) << 2;
  code = {};
  code.mode = mode_place(number, number_bits);
  if (code.mode < 0) return false;
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  const BitPlaces& places = bit_places[static_cast<std::size_t>(code.mode)];
  for (int i = 0; i < places.count; ++i) {
    const BitPlace p = places.places[static_cast<std::size_t>(i)];
    code.endpoints[p.endpoint][p.channel] |= bits.take(1) << p.bit;
  }
  if (mode.subsets == 2) code.partition = bits.take(5);
  resolve_endpoints(mode, is_signed, code);
  for (int t = 0; t < texel_count; ++t) {
    code.indices[static_cast<std::size_t>(t)] =
        static_cast<std::uint8_t>(bits.take(mode.index_bits() - (is_anchor(code, mode, t) ? 1 : 0)));
  }
  return true;
}

bool offsets_fit(const BlockCode& code) {
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  if (!mode.transformed) return true;
  for (std::size_t e = 1; e < static_cast<std::size_t>(2 * mode.subsets); ++e) {
    for (std::size_t c = 0; c < 3; ++c) {
      const int offset = code.endpoints[e][c] - code.endpoints[0][c];
      const int limit = 1 << (mode.delta_bits[c] - 1);
      if (offset < -limit || offset >= limit) return false;
    }
  }
  return true;
}

Bc6hBlock pack(const BlockCode& code) {
  assert(offsets_fit(code));
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  const BitPlaces& places = bit_places[static_cast<std::size_t>(code.mode)];
  BitWriter bits;
  bits.put(static_cast<unsigned>(mode.number), mode.number_bits);
  for (int i = 0; i < places.count; ++i) {
    const BitPlace p = places.places[static_cast<std::size_t>(i)];
    int value = code.endpoints[p.endpoint][p.channel];
    if (mode.transformed && p.endpoint > 0) value -= code.endpoints[0][p.channel];
    bits.put(static_cast<unsigned>(value) >> p.bit, 1);
  }
  if (mode.subsets == 2) bits.put(static_cast<unsigned>(code.partition), 5);
  for (int t = 0; t < texel_count; ++t) {
    const int stored = mode.index_bits() - (is_anchor(code, mode, t) ? 1 : 0);
    assert(code.indices[static_cast<std::size_t>(t)] < (1 << stored));
    bits.put(code.indices[static_cast<std::size_t>(t)], stored);
  }
  return bits.block();
}

void decode(const BlockCode& code, bool is_signed, std::uint16_t halves[48]) {
  const Mode& mode = modes[static_cast<std::size_t>(code.mode)];
  int positions[4][3] = {};
  for (std::size_t e = 0; e < static_cast<std::size_t>(2 * mode.subsets); ++e) {
    for (std::size_t c = 0; c < 3; ++c) {
      positions[e][c] = unquantise(code.endpoints[e][c], mode.endpoint_bits, is_signed);
    }
  }
  const int* weights = mode.subsets == 2 ? weights3.data() : weights4.data();
  for (int t = 0; t < texel_count; ++t) {
    const int first = 2 * subset_of(code, t);
    const int weight = weights[code.indices[static_cast<std::size_t>(t)]];
    for (int c = 0; c < 3; ++c) {
      const int position = interpolate(positions[first][c], positions[first + 1][c], weight);
      const int half = half_of_position(position, is_signed);
      halves[3 * t + c] = static_cast<std::uint16_t>(position < 0 ? 0x8000 | -half : half);  // -0 too
    }
  }
}

}  // namespace welkin::bc6h

namespace welkin {

void decode_bc6h_block(const Bc6hBlock& block, bool is_signed, std::uint16_t halves[48]) {
  bc6h::BlockCode code;
  if (bc6h::unpack(block, is_signed, code)) {
    bc6h::decode(code, is_signed, halves);
  } else {
    std::fill(halves, halves + 48, std::uint16_t{0});
  }
}

}  // namespace welkin
