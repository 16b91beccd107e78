#include <welkin/error.h>
#include <welkin/image/codecs/ktx2_zstd.h>

namespace welkin {

std::vector<std::uint8_t> compress_ktx2_level(std::span<const std::uint8_t>, int) {
  throw Error("KTX2 files cannot be compressed with Zstandard in this build; write them without");
}

std::vector<std::uint8_t> decompress_ktx2_level(std::span<const std::uint8_t>, std::size_t, std::size_t,
                                                std::string_view name) {
  throw Error(name,
              "is a KTX2 file compressed with Zstandard, which this build cannot read; write it without");
}

}  // namespace welkin
