#include <welkin/image/codecs/ktx2_zstd.h>

#include <zstd.h>

#include <string>

#include <welkin/error.h>

namespace welkin {
namespace {

// What the header claims is believed, and memory taken for it, only where the Zstandard frame says the same; a frame
// that does not say its size (streams may not) is given what ordinary pictures, but not bombs, unpack to.
void check_frame_size(std::span<const std::uint8_t> stored, std::size_t expected, std::size_t level,
                      std::string_view name) {
  constexpr std::size_t most_per_unsized_byte = 1000;
  const unsigned long long size = ZSTD_getFrameContentSize(stored.data(), stored.size());
  const bool believable = size == ZSTD_CONTENTSIZE_UNKNOWN
                              ? expected / most_per_unsized_byte <= stored.size()
                              : size != ZSTD_CONTENTSIZE_ERROR && size == expected;
  if (believable) return;
  throw Error(name, "mip level " + std::to_string(level) + " of this KTX2 file cannot be decompressed to " +
                        std::to_string(expected) + " bytes, which its header claims");
}

}  // namespace

std::vector<std::uint8_t> compress_ktx2_level(std::span<const std::uint8_t> bytes, int zstd_level) {
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), zstd_level);
  if (ZSTD_isError(size) != 0) throw Error(std::string("zstd cannot compress: ") + ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

std::vector<std::uint8_t> decompress_ktx2_level(std::span<const std::uint8_t> stored, std::size_t expected,
                                                std::size_t level, std::string_view name) {
  check_frame_size(stored, expected, level, name);
  std::vector<std::uint8_t> plain(expected);
  const std::size_t size = ZSTD_decompress(plain.data(), plain.size(), stored.data(), stored.size());
  if (ZSTD_isError(size) != 0 || size != expected)
    throw Error(name, "mip level " + std::to_string(level) + " of this KTX2 file cannot be decompressed");
  return plain;
}

}  // namespace welkin
