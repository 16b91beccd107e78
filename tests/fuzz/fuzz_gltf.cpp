#include <cstddef>
#include <cstdint>

#include <welkin/error.h>
#include <welkin/scene/gltf.h>

// The glTF reader may return or throw welkin::Error, whatever the bytes. Nothing outside them is opened.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    welkin::decode_gltf({data, size}, "fuzz", [](const std::string& reference) -> std::vector<std::uint8_t> {
      throw welkin::Error(reference, "not here");
    });
  } catch (const welkin::Error&) {
  }
  return 0;
}
