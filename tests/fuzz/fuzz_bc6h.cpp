#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <welkin/image/codecs/bc6h/bc6h.h>
#include <welkin/image/half.h>

// Any 16 bytes are a block: it decodes, both ways, to finite halves or to the one infinity that a signed block can hold.
// Any 48 floats (0 where the bytes end) encode at the speed that the first byte says, to a block that is not brighter.

namespace {

using namespace welkin;

void require(bool condition) {
  if (!condition) std::abort();
}

void decode_block(const Bc6hBlock& block) {
  std::uint16_t halves[48];
  decode_bc6h_block(block, false, halves);
  for (const std::uint16_t half : halves) require(half <= 0x7bff);
  decode_bc6h_block(block, true, halves);
  for (const std::uint16_t half : halves) require((half & 0x7fff) <= 0x7bff || half == 0xfc00);
}

// The magnitude of the half that the encoder rounds a value to.
int limit_of(float value, bool is_signed) {
  std::size_t clipped = 0;
  const int half = half_saturated(value, clipped);
  return (half & 0x8000) != 0 && !is_signed ? 0 : half & 0x7fff;
}

void encode_block(const float rgb[48], const Bc6hOptions& options) {
  std::size_t clipped = 0;
  std::uint16_t halves[48];
  decode_bc6h_block(encode_bc6h_block(rgb, options, clipped), options.is_signed, halves);
  for (int c = 0; c < 3; ++c) {
    int most = 0, got = 0;
    for (int i = c; i < 48; i += 3) {
      most = std::max(most, limit_of(rgb[i], options.is_signed));
      got = std::max(got, halves[i] & 0x7fff);
    }
    require(got <= most);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bc6hBlock block{};
  std::memcpy(block.data(), data, std::min<std::size_t>(size, 16));
  decode_block(block);
  float rgb[48] = {};
  std::memcpy(rgb, data, std::min<std::size_t>(size, sizeof rgb));
  const int first = size > 0 ? data[0] : 0;
  encode_block(rgb, {first % 2 == 1, static_cast<Bc6hSpeed>(first / 2 % 3)});
  return 0;
}
