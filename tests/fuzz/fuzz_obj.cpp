#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <welkin/error.h>
#include <welkin/scene/obj.h>

// The OBJ reader may return or throw welkin::Error, whatever the bytes. What lies between the first two zero bytes stands
// for the first file that the OBJ refers to (its materials), what follows them for all others (textures).

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::uint8_t* const end = data + size;
  const std::uint8_t* const first = std::find(data, end, 0);
  const std::uint8_t* const second = first == end ? end : std::find(first + 1, end, 0);
  int calls = 0;
  try {
    welkin::decode_obj({data, first}, "fuzz", [&](const std::string& reference) {
      const bool is_first = calls++ == 0;
      if ((is_first ? first : second) == end) throw welkin::Error(reference, "not here");
      return is_first ? std::vector<std::uint8_t>(first + 1, second)
                      : std::vector<std::uint8_t>(second + 1, end);
    });
  } catch (const welkin::Error&) {
  }
  return 0;
}
