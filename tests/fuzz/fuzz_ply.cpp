#include <cstddef>
#include <cstdint>

#include <welkin/error.h>
#include <welkin/scene/ply.h>

// The PLY reader may return or throw welkin::Error, whatever the bytes.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    welkin::decode_ply({data, size}, "fuzz");
  } catch (const welkin::Error&) {
  }
  return 0;
}
