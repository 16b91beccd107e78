#include <welkin/image/codecs/ktx2.h>

#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <zstd.h>

#include <gtest/gtest.h>

#include <welkin/error.h>

#include "tests/image/textures.h"

// Reads our files field by field with the numbers of the specifications spelled out (KTX 2.0 revision 4, Khronos Data
// Format 1.3, vulkan_core.h), sharing nothing with the encoder.

namespace welkin {
namespace {

struct Expected {
  PixelFormat format;
  std::uint32_t vk_format, type_size, texel_bytes, alignment;  // bytes of a texel or block
  std::vector<std::uint32_t> descriptor;
  std::uint32_t block = 1;  // texels along its edge
};

// Words of the descriptor: total size; vendor and type; version and block size; model, primaries, transfer, flags;
// texel block; bytesPlane0-3; bytesPlane4-7; then for each sample its place, position, lower, upper.
// A float sample's word has qualifiers float (0x80) and signed (0x40): 0xC0, 0xC1, 0xC2 and 0xCF for alpha, then
// bit length - 1, then bit offset. -1.0f is 0xBF800000, 1.0f is 0x3F800000.
const std::vector<Expected>& expectations() {
  static const std::vector<Expected> all = {
      {PixelFormat::rgba16f, 97, 2, 8, 8, {92,         0, 0x00580002, 0x00010101, 0, 8, 0,  //
                                           0xC00F0000, 0, 0xBF800000, 0x3F800000,           //
                                           0xC10F0010, 0, 0xBF800000, 0x3F800000,           //
                                           0xC20F0020, 0, 0xBF800000, 0x3F800000,           //
                                           0xCF0F0030, 0, 0xBF800000, 0x3F800000}},
      {PixelFormat::rgba32f, 109, 4, 16, 16, {92,         0, 0x00580002, 0x00010101, 0, 16, 0,  //
                                              0xC01F0000, 0, 0xBF800000, 0x3F800000,            //
                                              0xC11F0020, 0, 0xBF800000, 0x3F800000,            //
                                              0xC21F0040, 0, 0xBF800000, 0x3F800000,            //
                                              0xCF1F0060, 0, 0xBF800000, 0x3F800000}},
      // Mantissa and exponent (0x20) of red, green, blue; the exponent's bias 15 and its largest value 31.
      {PixelFormat::rgb9e5, 123, 4, 4, 4, {124,        0, 0x00780002, 0x00010101, 0, 4, 0,  //
                                           0x00080000, 0, 0,          8448,                 //
                                           0x2004001B, 0, 15,         31,                   //
                                           0x01080009, 0, 0,          8448,                 //
                                           0x2104001B, 0, 15,         31,                   //
                                           0x02080012, 0, 0,          8448,                 //
                                           0x2204001B, 0, 15,         31}},
      {PixelFormat::rg16f,
       83,
       2,
       4,
       4,
       {60, 0, 0x00380002, 0x00010101, 0, 4, 0,  //
        0xC00F0000, 0, 0xBF800000, 0x3F800000,   //
        0xC10F0010, 0, 0xBF800000, 0x3F800000}},
      {PixelFormat::rg32f,
       103,
       4,
       8,
       8,
       {60, 0, 0x00380002, 0x00010101, 0, 8, 0,  //
        0xC01F0000, 0, 0xBF800000, 0x3F800000,   //
        0xC11F0020, 0, 0xBF800000, 0x3F800000}},
      // Unsigned floats (0x80): 11 bits at 0 and 11, 10 bits at 22.
      {PixelFormat::r11g11b10f,
       122,
       4,
       4,
       4,
       {76, 0, 0x00480002, 0x00010101, 0, 4, 0,  //
        0x800A0000, 0, 0, 0x3F800000,            //
        0x810A000B, 0, 0, 0x3F800000,            //
        0x82090016, 0, 0, 0x3F800000}},
      // Models BC6H = 133 and ASTC = 162, block dimensions less one, one sample of 128 bits.
      {PixelFormat::bc6h,
       143,
       1,
       16,
       16,
       {44, 0, 0x00280002, 0x00010185, 0x0303, 16, 0,  //
        0x807F0000, 0, 0, 0x3F800000},
       4},
      {PixelFormat::bc6h_signed,
       144,
       1,
       16,
       16,
       {44, 0, 0x00280002, 0x00010185, 0x0303, 16, 0,  //
        0xC07F0000, 0, 0xBF800000, 0x3F800000},
       4},
      {PixelFormat::astc,
       1000066000,
       1,
       16,
       16,
       {44, 0, 0x00280002, 0x000101A2, 0x0303, 16, 0,  //
        0xC07F0000, 0, 0xBF800000, 0x3F800000},
       4},
      {PixelFormat::astc6x6,
       1000066004,
       1,
       16,
       16,
       {44, 0, 0x00280002, 0x000101A2, 0x0505, 16, 0,  //
        0xC07F0000, 0, 0xBF800000, 0x3F800000},
       6},
  };
  return all;
}

template <class T>
T field(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  T value{};
  EXPECT_LE(offset + sizeof value, bytes.size());
  std::memcpy(&value, bytes.data() + std::min(offset, bytes.size() - sizeof value), sizeof value);
  return value;
}

std::uint32_t u32(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  return field<std::uint32_t>(bytes, offset);
}
std::uint64_t u64(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
  return field<std::uint64_t>(bytes, offset);
}

void expect_header(const std::vector<std::uint8_t>& bytes, const Expected& expected,
                   const std::array<std::uint32_t, 5>& shape, std::uint32_t scheme) {
  const std::array<std::uint8_t, 12> identifier = {0xAB, 0x4B, 0x54, 0x58, 0x20, 0x32,
                                                   0x30, 0xBB, 0x0D, 0x0A, 0x1A, 0x0A};
  ASSERT_GE(bytes.size(), 80u);
  EXPECT_EQ(std::memcmp(bytes.data(), identifier.data(), 12), 0);
  EXPECT_EQ(u32(bytes, 12), expected.vk_format);
  EXPECT_EQ(u32(bytes, 16), expected.type_size);
  EXPECT_EQ(u32(bytes, 20), shape[0]);  // pixelWidth
  EXPECT_EQ(u32(bytes, 24), shape[1]);  // pixelHeight
  EXPECT_EQ(u32(bytes, 28), 0u);        // pixelDepth
  EXPECT_EQ(u32(bytes, 32), 0u);        // layerCount
  EXPECT_EQ(u32(bytes, 36), shape[2]);  // faceCount
  EXPECT_EQ(u32(bytes, 40), shape[3]);  // levelCount
  EXPECT_EQ(u32(bytes, 44), scheme);
  EXPECT_EQ(u32(bytes, 48), 80 + 24 * shape[3]);  // the descriptor follows the level index
  EXPECT_EQ(u32(bytes, 52), 4 * expected.descriptor.size());
  EXPECT_EQ(u32(bytes, 56), u32(bytes, 48) + u32(bytes, 52));  // the keys follow the descriptor
  EXPECT_EQ(u64(bytes, 64), 0u);                               // no supercompression global data
  EXPECT_EQ(u64(bytes, 72), 0u);
}

void expect_descriptor(const std::vector<std::uint8_t>& bytes, const Expected& expected) {
  for (std::size_t i = 0; i < expected.descriptor.size(); ++i) {
    EXPECT_EQ(u32(bytes, u32(bytes, 48) + 4 * i), expected.descriptor[i]) << "word " << i;
  }
}

// Levels lie from the smallest to the largest, each on the next aligned offset, the last one ends the file.
void expect_levels(const std::vector<std::uint8_t>& bytes, const Expected& expected, std::uint32_t faces,
                   bool compressed) {
  const std::uint32_t levels = u32(bytes, 40);
  const std::uint64_t alignment = compressed ? 1 : expected.alignment;
  std::uint64_t end = u32(bytes, 56) + u32(bytes, 60);
  for (std::uint32_t k = levels; k-- > 0;) {
    const std::uint64_t offset = u64(bytes, 80 + 24 * k), length = u64(bytes, 88 + 24 * k);
    const std::uint64_t width = std::max(1u, u32(bytes, 20) >> k), height = std::max(1u, u32(bytes, 24) >> k);
    EXPECT_EQ(offset, (end + alignment - 1) / alignment * alignment) << "level " << k;
    const std::uint64_t b = expected.block, units = (width + b - 1) / b * ((height + b - 1) / b);
    EXPECT_EQ(u64(bytes, 96 + 24 * k), faces * units * expected.texel_bytes) << "level " << k;
    EXPECT_EQ(compressed ? ZSTD_getFrameContentSize(bytes.data() + offset, length) : length,
              u64(bytes, 96 + 24 * k));
    for (std::uint64_t i = end; i < offset; ++i) EXPECT_EQ(bytes.at(i), 0) << "padding";
    end = offset + length;
  }
  EXPECT_EQ(end, bytes.size());
}

TEST(Ktx2Bytes, Cubes) {
  for (const Expected& expected : expectations()) {
    for (const bool compressed : {false, true}) {
      for (const int size : {1, 2, 6, expected.block > 1 ? 12 : 64}) {  // blocks take their time
        for (const bool full : {false, true}) {
          const CubeMips cube = test_cube(size, full);
          Ktx2Options options;
          options.format = expected.format;
          options.zstd_level = compressed ? 3 : 0;
          options.quality = BlockQuality::fast;
          const std::vector<std::uint8_t> bytes = encode_ktx2(cube, options).bytes;
          const auto side = static_cast<std::uint32_t>(size);
          expect_header(bytes, expected, {side, side, 6, static_cast<std::uint32_t>(cube.levels.size()), 0},
                        compressed ? 2 : 0);
          expect_descriptor(bytes, expected);
          expect_levels(bytes, expected, 6, compressed);
        }
      }
    }
  }
}

TEST(Ktx2Bytes, FlatImages) {
  for (const Expected& expected : expectations()) {
    for (const bool compressed : {false, true}) {
      Ktx2Options options;
      options.format = expected.format;
      options.zstd_level = compressed ? 3 : 0;
      const std::vector<std::uint8_t> bytes = encode_ktx2(test_image(5, 3), options).bytes;
      expect_header(bytes, expected, {5, 3, 1, 1, 0}, compressed ? 2 : 0);
      expect_descriptor(bytes, expected);
      expect_levels(bytes, expected, 1, compressed);
    }
  }
}

// Tables: the numbers as they are, alpha and those that no texture format takes included.
TEST(Ktx2Bytes, Tables) {
  const std::vector<Expected> all = {
      {PixelFormat::rgba32f,
       100,
       4,
       4,
       4,
       {44, 0, 0x00280002, 0x00010101, 0, 4, 0, 0xC01F0000, 0, 0xBF800000, 0x3F800000}},
      expectations().at(4),
      {PixelFormat::rgba32f,
       106,
       4,
       12,
       12,
       {76, 0, 0x00480002, 0x00010101, 0, 12, 0, 0xC01F0000, 0, 0xBF800000, 0x3F800000, 0xC11F0020, 0,
        0xBF800000, 0x3F800000, 0xC21F0040, 0, 0xBF800000, 0x3F800000}},
      expectations().at(1)};
  for (int channels = 1; channels <= 4; ++channels) {
    const Expected& expected = all.at(static_cast<std::size_t>(channels - 1));
    Image table = test_image(5, 3, channels);
    table.pixels[1] = -0.0f;
    table.pixels[2] = std::numeric_limits<float>::infinity();
    const std::vector<std::uint8_t> bytes = encode_ktx2_table(table, {{"WelkinQuantity", "x"}});
    expect_header(bytes, expected, {5, 3, 1, 1, 0}, 0);
    expect_descriptor(bytes, expected);
    expect_levels(bytes, expected, 1, false);
    const std::size_t size = table.pixels.size() * sizeof(float);
    EXPECT_EQ(std::memcmp(bytes.data() + bytes.size() - size, table.pixels.data(), size), 0);
    const Image back = decode_ktx2(bytes, "table").flat;
    for (int i = 0; i < 15; ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(back.at(i % 5, i / 5)[c], channels == 1  ? table.pixels[i]
                                            : c < channels ? table.at(i % 5, i / 5)[c]
                                                           : 0.0f)
            << i << " " << c;
    EXPECT_EQ(read_ktx2_keys(bytes, "table").at("WelkinQuantity"), "x");
  }
  EXPECT_THROW(encode_ktx2_table(Image()), Error);
  EXPECT_THROW(encode_ktx2_table(test_image(1, 1), {{"KTXnumber", "1"}}), Error);
}

// The whole key/value block, byte by byte: entries sorted, texts end with a zero, entries padded to 4.
TEST(Ktx2Bytes, KeyValueData) {
  Ktx2Options options;
  options.keys = {{"WelkinQuantity", "x"}};
  options.stored_scale = 8;
  const std::vector<std::uint8_t> bytes = encode_ktx2(test_image(2, 2), options).bytes;
  using namespace std::string_literals;
  const std::string expected =
      "\x12\0\0\0KTXorientation\0rd\0\0\0"s       // 15 + 3 = 18 bytes, 2 of padding
      "\x15\0\0\0KTXwriter\0welkin 0.1\0\0\0\0"s  // 10 + 11 = 21, 3
      "\x11\0\0\0WelkinQuantity\0x\0\0\0\0"s      // 15 + 2 = 17, 3
      "\x14\0\0\0WelkinStoredScale\0"
      "8\0"s;  // 18 + 2 = 20, 0
  const std::string actual(bytes.begin() + u32(bytes, 56), bytes.begin() + u32(bytes, 56) + u32(bytes, 60));
  EXPECT_EQ(actual, expected);
}

// Faces follow one another inside a level, rows from the top; half 1.0 is 0x3C00.
TEST(Ktx2Bytes, TexelsLieFaceAfterFace) {
  CubeMips cube;
  cube.levels = {Cube(2), Cube(1)};
  for (std::size_t i = 0; i < 72; ++i) cube.levels[0].texels[i] = static_cast<float>(i);
  for (std::size_t i = 0; i < 18; ++i) cube.levels[1].texels[i] = 100.0f + static_cast<float>(i);
  Ktx2Options options;
  options.format = PixelFormat::rgba32f;
  const std::vector<std::uint8_t> bytes = encode_ktx2(cube, options).bytes;
  for (std::size_t texel = 0; texel < 24; ++texel) {
    const std::size_t at = u64(bytes, 80) + 16 * texel;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(field<float>(bytes, at + 4 * c), static_cast<float>(3 * texel + c));
    EXPECT_EQ(field<float>(bytes, at + 12), 1.0f);
  }
  for (std::size_t face = 0; face < 6; ++face) {
    EXPECT_EQ(field<float>(bytes, u64(bytes, 104) + 16 * face), 100.0f + 3 * static_cast<float>(face));
  }
}

}  // namespace
}  // namespace welkin
