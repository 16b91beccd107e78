#include <welkin/image/codecs/ktx2.h>

#include <sys/resource.h>

#include <cstring>
#include <random>
#include <string>
#include <vector>

#include <zstd.h>

#include <gtest/gtest.h>

#include "tests/image/prefixes.h"
#include "tests/image/textures.h"

// Damaged and hostile KTX2 files. Byte offsets are those of the KTX 2.0 header.

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

void decode(std::span<const std::uint8_t> bytes) { decode_ktx2(bytes, "small.ktx2"); }

Bytes small_cube(int zstd_level, PixelFormat format = PixelFormat::rgba16f) {
  Ktx2Options options;
  options.format = format;
  options.zstd_level = zstd_level;
  return encode_ktx2(test_cube(4, true), options).bytes;
}

Bytes small_image(int zstd_level) {
  Ktx2Options options;
  options.zstd_level = zstd_level;
  return encode_ktx2(test_image(5, 3), options).bytes;
}

template <class T>
Bytes with(Bytes bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof value);
  return bytes;
}

Bytes with32(const Bytes& bytes, std::size_t offset, std::uint32_t value) {
  return with(bytes, offset, value);
}
Bytes with64(const Bytes& bytes, std::size_t offset, std::uint64_t value) {
  return with(bytes, offset, value);
}

void expect_refused(const Bytes& bytes, const std::string& reason) {
  const std::string message = refusal(bytes, decode);
  EXPECT_TRUE(message.starts_with("small.ktx2: ")) << message;
  EXPECT_NE(message.find(reason), std::string::npos) << message;
}

TEST(Ktx2Damage, EveryPrefixOfBlocksIsRefused) {
  for (const PixelFormat format : {PixelFormat::bc6h, PixelFormat::r11g11b10f})
    expect_every_prefix_refused(small_cube(0, format), "small.ktx2", decode);
}

// The last block of a file is overwritten with zeros, an encoding that ASTC reserves.
TEST(Ktx2Damage, InvalidBlocksAreRefused) {
  for (const PixelFormat format : {PixelFormat::astc, PixelFormat::astc6x6}) {
    Bytes bytes = small_cube(0, format);
    std::fill(bytes.begin() + 300, bytes.end(), std::uint8_t{0});
    expect_refused(bytes, "ASTC block");
    expect_refused(Bytes(bytes.begin(), bytes.end() - 1), "cut off");
  }
}

TEST(Ktx2Damage, EveryPrefixIsRefused) {
  for (const int zstd_level : {0, 3}) {
    expect_every_prefix_refused(small_cube(zstd_level), "small.ktx2", decode);
    expect_every_prefix_refused(small_image(zstd_level), "small.ktx2", decode);
  }
}

TEST(Ktx2Damage, WrongHeaderFields) {
  for (const int zstd_level : {0, 3}) {
    const Bytes good = small_cube(zstd_level);
    ASSERT_EQ(refusal(good, decode), "(accepted)");
    expect_refused(with(good, 5, '1'), "not a KTX2 file");
    expect_refused(with32(good, 12, 0), "VkFormat 0");    // Basis and other unnamed formats
    expect_refused(with32(good, 12, 37), "VkFormat 37");  // R8G8B8A8_UNORM
    expect_refused(with32(good, 20, 0), "not square");
    expect_refused(with32(small_image(zstd_level), 20, 0), "no pixels");
    expect_refused(with32(good, 20, 100000), "not square");
    expect_refused(with32(with32(good, 20, 100000), 24, 100000), "100000");
    expect_refused(with32(with32(good, 20, 0xffffffff), 24, 0xffffffff), "4294967295");
    expect_refused(with32(good, 24, 0), "1-D");
    expect_refused(with32(good, 28, 1), "3-D");
    expect_refused(with32(good, 32, 2), "arrays");
    expect_refused(with32(good, 36, 5), "1 or 6 faces");
    expect_refused(with32(good, 36, 0), "1 or 6 faces");
    expect_refused(with32(good, 40, 200), "mip levels");
    expect_refused(with32(good, 40, 4), "mip levels");
    expect_refused(with32(good, 44, 1), "scheme 1");
    expect_refused(with32(good, 44, 3), "scheme 3");
  }
}

TEST(Ktx2Damage, OffsetsBeyondTheEnd) {
  const Bytes good = small_cube(0);
  expect_refused(with32(good, 48, 0xfffffff0), "descriptor");
  expect_refused(with32(good, 52, 0xfffffff0), "descriptor");
  expect_refused(with32(good, 56, 0xfffffff0), "key/value");
  expect_refused(with32(good, 60, 0xfffffff0), "key/value");
  for (std::size_t level = 0; level < 3; ++level) {
    const std::size_t entry = 80 + 24 * level;
    expect_refused(with64(good, entry, good.size()), "image data");
    expect_refused(with64(good, entry, ~std::uint64_t{0}), "image data");
    expect_refused(with64(good, entry + 8, ~std::uint64_t{0}), "image data");
    expect_refused(with64(with64(good, entry, 16), entry + 8, ~std::uint64_t{0} - 8),
                   "image data");  // sum wraps
  }
}

TEST(Ktx2Damage, SizesThatLie) {
  for (const int zstd_level : {0, 3}) {
    const Bytes good = small_cube(zstd_level);
    expect_refused(with64(good, 96, 0), "wrong size");
    expect_refused(with64(good, 96, 6 * 16 * 8 + 1), "wrong size");
    expect_refused(with64(good, 96, std::uint64_t{1} << 60), "wrong size");
  }
  expect_refused(with64(small_cube(0), 88, 6 * 16 * 8 - 1), "wrong size");
  const std::uint32_t no_scheme = 0;
  expect_refused(with32(small_cube(3), 44, no_scheme), "wrong size");
  expect_refused(with32(small_cube(0), 44, 2), "decompressed");
}

TEST(Ktx2Damage, ZstdGarbage) {
  const Bytes good = small_cube(3);
  std::uint64_t offset = 0, length = 0;
  std::memcpy(&offset, good.data() + 80, 8);
  std::memcpy(&length, good.data() + 88, 8);
  Bytes bad = good;
  std::mt19937 random(5);
  for (std::uint64_t i = 0; i < length; ++i) bad[offset + i] = static_cast<std::uint8_t>(random());
  expect_refused(bad, "decompressed");
  expect_refused(with64(good, 88, length - 1), "decompressed");
  expect_refused(with64(good, 88, 0), "decompressed");
}

// A frame that unpacks to more, or to less, than the level needs.
TEST(Ktx2Damage, ZstdOfAnotherSize) {
  for (const std::size_t size :
       {std::size_t{6 * 16 * 8 - 1}, std::size_t{6 * 16 * 8 + 1}, std::size_t{1} << 20}) {
    const Bytes plain(size);
    Bytes frame(ZSTD_compressBound(size));
    frame.resize(ZSTD_compress(frame.data(), frame.size(), plain.data(), plain.size(), 3));
    Bytes bytes = small_cube(3);
    bytes = with64(with64(bytes, 80, bytes.size()), 88, frame.size());
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    expect_refused(bytes, "decompressed");
  }
}

// A header that asks for far more than any compression could hold in these bytes takes no memory.
TEST(Ktx2Damage, ZstdBombIsRefusedByItsSize) {
  const Bytes bytes = small_cube(3);
  expect_refused(with32(with32(bytes, 20, 16384), 24, 16384), "cannot hold");
}

// The largest memory that this process has had, in bytes.
long peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss * 1024;
}

// A file whose one level of size x size half floats is this Zstandard frame.
Bytes with_frame(std::uint32_t size, const Bytes& frame) {
  Bytes bytes = with32(with32(small_image(3), 20, size), 24, size);
  bytes = with64(with64(bytes, 80, bytes.size()), 88, frame.size());
  bytes = with64(bytes, 96, std::uint64_t{size} * size * 8);
  bytes.insert(bytes.end(), frame.begin(), frame.end());
  return bytes;
}

Bytes streamed_frame(const Bytes& plain) {  // does not say its size
  ZSTD_CStream* stream = ZSTD_createCStream();
  Bytes frame(ZSTD_compressBound(plain.size()));
  ZSTD_inBuffer in{plain.data(), plain.size(), 0};
  ZSTD_outBuffer out{frame.data(), frame.size(), 0};
  ZSTD_compressStream2(stream, &out, &in, ZSTD_e_flush);
  ZSTD_compressStream2(stream, &out, &in, ZSTD_e_end);
  ZSTD_freeCStream(stream);
  frame.resize(out.pos);
  return frame;
}

// 128 MiB are claimed, which 8 KiB of Zstandard could hold: what the frame says is looked at before memory is taken.
TEST(Ktx2Damage, ZstdFrameThatHoldsLessThanTheHeaderClaimsTakesNoMemory) {
  Bytes noise(8192);
  std::mt19937 random(7);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
  Bytes sized(ZSTD_compressBound(noise.size()));
  sized.resize(ZSTD_compress(sized.data(), sized.size(), noise.data(), noise.size(), 3));
  const long before = peak_memory();
  expect_refused(with_frame(4096, sized), "decompressed to 134217728 bytes");
  expect_refused(with_frame(4096, streamed_frame(noise)), "decompressed to 134217728 bytes");
  EXPECT_LT(peak_memory() - before, 32 << 20);  // a quarter of the claim; the files themselves are small
}

// Streams without a size are read as long as what is claimed is believable: up to 1000 times their bytes.
TEST(Ktx2Damage, ZstdFrameWithoutItsSizeIsRead) {
  Bytes plain(64 * 64 * 8);
  std::mt19937 random(8);
  for (std::size_t i = 0; i < plain.size(); i += 64) plain[i] = static_cast<std::uint8_t>(random() % 60);
  const Bytes frame = streamed_frame(plain);
  ASSERT_EQ(ZSTD_getFrameContentSize(frame.data(), frame.size()), ZSTD_CONTENTSIZE_UNKNOWN);
  EXPECT_EQ(refusal(with_frame(64, frame), decode), "(accepted)");
}

TEST(Ktx2Damage, BadKeys) {
  const Bytes good = small_cube(0);
  std::uint32_t keys = 0;
  std::memcpy(&keys, good.data() + 56, 4);
  expect_refused(with32(good, keys, 0xffffffff), "key/value");
  expect_refused(with32(good, keys, 4), "no end");
  expect_refused(with32(good, 60, 3), "key/value");
  Ktx2Options options;
  options.stored_scale = 2;
  Bytes scale = encode_ktx2(test_image(2, 2), options).bytes;  // the last entry is WelkinStoredScale: "2"
  std::uint32_t size = 0;
  std::memcpy(&keys, scale.data() + 56, 4);
  std::memcpy(&size, scale.data() + 60, 4);
  for (const char digit : {'0', 'x', '-', ' '}) {
    scale[keys + size - 2] = static_cast<std::uint8_t>(digit);
    expect_refused(scale, "WelkinStoredScale");
  }
}

// Any flipped byte is either refused by name or decodes; nothing else happens (sanitizers watch).
TEST(Ktx2Damage, RandomBytesNeverCrash) {
  std::mt19937 random(17);
  for (const Bytes& good : {small_cube(0), small_cube(3), small_image(0), small_image(3)}) {
    for (int i = 0; i < 4000; ++i) {
      Bytes bad = good;
      const std::size_t range = i % 2 == 0 ? bad.size() : std::min<std::size_t>(bad.size(), 160);
      for (int flips = 0; flips < 1 + i % 3; ++flips)
        bad[random() % range] = static_cast<std::uint8_t>(random());
      const std::string message = refusal(bad, decode);
      ASSERT_TRUE(message == "(accepted)" || message.starts_with("small.ktx2: ")) << message;
    }
  }
}

TEST(Ktx2Damage, ForeignFilesThatAreFine) {
  Bytes bytes = small_image(0);
  const auto key = std::string("KTXorientation");
  const auto at = std::search(bytes.begin(), bytes.end(), key.begin(), key.end()) - bytes.begin();
  const Image upright = decode_ktx2(bytes, "a").flat;
  bytes[static_cast<std::size_t>(at) + 15] = 'l';
  bytes[static_cast<std::size_t>(at) + 16] = 'u';
  const Image turned = decode_ktx2(bytes, "a").flat;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      for (int c = 0; c < 3; ++c) ASSERT_EQ(turned.at(x, y)[c], upright.at(4 - x, 2 - y)[c]);
    }
  }
  EXPECT_EQ(refusal(with32(bytes, 40, 0), decode), "(accepted)");  // level count 0: one is stored
  std::uint32_t descriptor = 0;
  std::memcpy(&descriptor, bytes.data() + 48, 4);
  bytes[descriptor + 13] = 9;  // primaries
  bytes[descriptor + 14] = 2;  // transfer function sRGB
  EXPECT_EQ(decode_ktx2(bytes, "a").warnings.size(), 2u);
}

// Three-channel formats, which we do not write: the same file with another VkFormat and its own data.
TEST(Ktx2Damage, ThreeChannelFormatsAreRead) {
  Ktx2Options options;
  options.format = PixelFormat::rg16f;
  Bytes bytes = encode_ktx2(test_image(2, 1), options).bytes;
  const std::vector<std::uint16_t> halves = {0x3c00, 0x4000, 0x4200,
                                             0x3800, 0x3400, 0xbc00};  // 1 2 3 .5 .25 -1
  bytes = with64(with64(with64(with32(bytes, 12, 90), 80, bytes.size()), 88, 12), 96, 12);
  const auto* first = reinterpret_cast<const std::uint8_t*>(halves.data());
  bytes.insert(bytes.end(), first, first + 12);
  EXPECT_EQ(decode_ktx2(bytes, "a").flat.pixels, (std::vector<float>{1, 2, 3, 0.5f, 0.25f, -1}));
  const std::vector<float> floats = {1, 2, 3, 4, 5, 6};
  bytes = with64(with64(with64(with32(bytes, 12, 106), 80, bytes.size()), 88, 24), 96, 24);
  const auto* begin = reinterpret_cast<const std::uint8_t*>(floats.data());
  bytes.insert(bytes.end(), begin, begin + 24);
  EXPECT_EQ(decode_ktx2(bytes, "a").flat.pixels, floats);
}

}  // namespace
}  // namespace welkin
