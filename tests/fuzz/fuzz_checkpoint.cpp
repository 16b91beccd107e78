#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <welkin/error.h>
#include <welkin/pathtrace/checkpoint.h>
#include <welkin/pathtrace/fingerprint.h>

// The reader of unfinished pictures may return or throw welkin::Error, whatever the bytes. Chance never finds a checksum,
// so the same bytes are tried with the right one too; what then comes back can be shown, and gives the same bytes again.

namespace {

using namespace welkin;

constexpr PictureSize size{3, 2};
constexpr std::uint64_t fingerprint = 0x0123456789abcdef;

bool decodes(const std::vector<std::uint8_t>& bytes) {
  try {
    const PictureState state = decode_checkpoint(bytes, "fuzz", size, fingerprint);
    make_picture_layers(state);
    if (encode_checkpoint(state, fingerprint) != bytes) std::abort();
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t count) {
  std::vector<std::uint8_t> bytes(data, data + count);
  decodes(bytes);
  constexpr std::size_t checksum_size = sizeof(std::uint64_t);
  if (count < checksum_size) return 0;
  const std::uint64_t checksum = content_hash(std::span(bytes).first(count - checksum_size));
  std::memcpy(bytes.data() + count - checksum_size, &checksum, checksum_size);
  decodes(bytes);
  return 0;
}
