#include <welkin/image/codecs/dds.h>

#include <cstring>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <welkin/error.h>

#include "tests/image/prefixes.h"
#include "tests/image/textures.h"

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr PixelFormat all_formats[] = {PixelFormat::rgba16f, PixelFormat::rgba32f, PixelFormat::rgb9e5,
                                       PixelFormat::rg16f,   PixelFormat::rg32f,   PixelFormat::r11g11b10f};

void decode(std::span<const std::uint8_t> bytes) { decode_dds(bytes, "small.dds"); }

std::uint32_t u32(const Bytes& bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, 4);
  return value;
}

Bytes with32(Bytes bytes, std::size_t offset, std::uint32_t value) {
  std::memcpy(bytes.data() + offset, &value, 4);
  return bytes;
}

void expect_refused(const Bytes& bytes, const std::string& reason) {
  const std::string message = refusal(bytes, decode);
  EXPECT_TRUE(message.starts_with("small.dds: ")) << message;
  EXPECT_NE(message.find(reason), std::string::npos) << message;
}

void expect_within_rounding(std::span<const float> before, std::span<const float> after, PixelFormat format) {
  ASSERT_EQ(before.size(), after.size());
  const std::size_t stored =
      std::min<std::size_t>(3, static_cast<std::size_t>(pixel_layout(format).channels));
  for (std::size_t i = 0; i < before.size(); i += 3) {
    const double largest = std::max({before[i], before[i + 1], before[i + 2]});
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = c < stored ? static_cast<double>(before[i + c]) : 0.0;
      ASSERT_NEAR(after[i + c], expected, rounding(format, before[i + c], largest)) << i << " " << c;
    }
  }
}

TEST(Dds, CubesComeBackWithinRounding) {
  for (const PixelFormat format : all_formats) {
    for (const auto& [size, full] : {std::tuple{1, false}, {2, true}, {6, true}, {7, false}, {32, true}}) {
      const CubeMips cube = test_cube(size, full);
      DdsOptions options;
      options.format = format;
      const EncodedTexture texture = encode_dds(cube, options);
      EXPECT_EQ(texture.clipped, 0u);
      const LoadedImage back = decode_dds(texture.bytes, "memory");
      ASSERT_EQ(back.cube.levels.size(), cube.levels.size());
      for (std::size_t k = 0; k < cube.levels.size(); ++k) {
        expect_within_rounding(cube.levels[k].texels, back.cube.levels[k].texels, format);
      }
    }
  }
}

TEST(Dds, FlatImagesComeBackWithinRounding) {
  for (const PixelFormat format : all_formats) {
    const Image image = test_image(13, 5);
    DdsOptions options;
    options.format = format;
    const LoadedImage back = decode_dds(encode_dds(image, options).bytes, "memory");
    ASSERT_FALSE(back.is_cube());
    ASSERT_EQ(back.flat.width, 13);
    expect_within_rounding(image.pixels, back.flat.pixels, format);
  }
}

TEST(Dds, TheScaleIsReturned) {
  CubeMips cube = test_cube(2, false);
  cube.levels[0].texels[0] = 200000;
  const EncodedTexture texture = encode_dds(cube);
  EXPECT_EQ(texture.stored_scale, 4);
  EXPECT_EQ(texture.clipped, 0u);
  EXPECT_NEAR(decode_dds(texture.bytes, "memory").cube.levels[0].texels[0], 50000, 16);  // half the unit 32
  DdsOptions options;
  options.range = RangePolicy::clip;
  EXPECT_EQ(encode_dds(cube, options).clipped, 1u);
  options.stored_scale = 16;
  EXPECT_EQ(decode_dds(encode_dds(cube, options).bytes, "memory").cube.levels[0].texels[0],
            12496);  // 12500 is half way between 12496 and 12504
}

// Field by field, with the numbers of the DDS programming guide and dxgiformat.h.
TEST(Dds, HeaderOfACube) {
  const std::vector<std::tuple<PixelFormat, std::uint32_t, std::uint32_t>> formats = {
      {PixelFormat::rgba16f, 10, 8}, {PixelFormat::rgba32f, 2, 16}, {PixelFormat::rgb9e5, 67, 4},
      {PixelFormat::rg16f, 34, 4},   {PixelFormat::rg32f, 16, 8},   {PixelFormat::r11g11b10f, 26, 4}};
  for (const auto& [format, dxgi, texel] : formats) {
    DdsOptions options;
    options.format = format;
    const Bytes bytes = encode_dds(test_cube(6, true), options).bytes;
    EXPECT_EQ(std::memcmp(bytes.data(), "DDS ", 4), 0);
    EXPECT_EQ(u32(bytes, 4), 124u);
    EXPECT_EQ(u32(bytes, 8), 0x2100Fu);  // caps, height, width, pitch, pixel format, mip count
    EXPECT_EQ(u32(bytes, 12), 6u);
    EXPECT_EQ(u32(bytes, 16), 6u);
    EXPECT_EQ(u32(bytes, 20), 6 * texel);
    EXPECT_EQ(u32(bytes, 28), 3u);  // 6, 3, 1
    EXPECT_EQ(u32(bytes, 76), 32u);
    EXPECT_EQ(u32(bytes, 80), 4u);
    EXPECT_EQ(std::memcmp(bytes.data() + 84, "DX10", 4), 0);
    EXPECT_EQ(u32(bytes, 108), 0x401008u);  // texture, complex, mipmap
    EXPECT_EQ(u32(bytes, 112), 0xFE00u);    // cube with six faces
    EXPECT_EQ(u32(bytes, 128), dxgi);
    EXPECT_EQ(u32(bytes, 132), 3u);  // 2-D
    EXPECT_EQ(u32(bytes, 136), 4u);  // cube
    EXPECT_EQ(u32(bytes, 140), 1u);
    EXPECT_EQ(u32(bytes, 144), 0u);
    EXPECT_EQ(bytes.size(), 148 + 6 * (36 + 9 + 1) * texel);
  }
}

// The pitch becomes the bytes of the largest level; levels of 6, 3 and 1 have 4, 1 and 1 blocks.
TEST(Dds, HeaderOfBlocks) {
  for (const auto& [format, dxgi] : {std::tuple{PixelFormat::bc6h, 95u}, {PixelFormat::bc6h_signed, 96u}}) {
    DdsOptions options;
    options.format = format;
    const Bytes bytes = encode_dds(test_cube(6, true), options).bytes;
    EXPECT_EQ(u32(bytes, 8), 0xA1007u);  // linear size instead of pitch
    EXPECT_EQ(u32(bytes, 20), 64u);
    EXPECT_EQ(u32(bytes, 128), dxgi);
    EXPECT_EQ(bytes.size(), 148u + 6 * (4 + 1 + 1) * 16);
    EXPECT_EQ(decode_dds(bytes, "memory").cube.levels.size(), 3u);
  }
  DdsOptions options;
  options.format = PixelFormat::astc;
  EXPECT_THROW(encode_dds(test_cube(4, false), options), Error);
}

TEST(Dds, HeaderOfAFlatImage) {
  const Bytes bytes = encode_dds(test_image(5, 3)).bytes;
  EXPECT_EQ(u32(bytes, 8), 0x100Fu);
  EXPECT_EQ(u32(bytes, 12), 3u);
  EXPECT_EQ(u32(bytes, 16), 5u);
  EXPECT_EQ(u32(bytes, 28), 1u);
  EXPECT_EQ(u32(bytes, 108), 0x1000u);
  EXPECT_EQ(u32(bytes, 112), 0u);
  EXPECT_EQ(u32(bytes, 136), 0u);
  EXPECT_EQ(bytes.size(), 148u + 5 * 3 * 8);
}

// Each face has its own levels after it: the order of floats in the file.
TEST(Dds, FacesHoldTheirLevels) {
  CubeMips cube;
  cube.levels = {Cube(2), Cube(1)};
  for (std::size_t i = 0; i < 72; ++i) cube.levels[0].texels[i] = static_cast<float>(i);
  for (std::size_t i = 0; i < 18; ++i) cube.levels[1].texels[i] = 100.0f + static_cast<float>(i);
  DdsOptions options;
  options.format = PixelFormat::rgba32f;
  const Bytes bytes = encode_dds(cube, options).bytes;
  for (std::size_t face = 0; face < 6; ++face) {
    for (std::size_t texel = 0; texel < 5; ++texel) {
      float red = 0, alpha = 0;
      std::memcpy(&red, bytes.data() + 148 + 16 * (5 * face + texel), 4);
      std::memcpy(&alpha, bytes.data() + 148 + 16 * (5 * face + texel) + 12, 4);
      const std::size_t expected = texel < 4 ? 3 * (4 * face + texel) : 100 + 3 * face;
      EXPECT_EQ(red, static_cast<float>(expected));
      EXPECT_EQ(alpha, 1.0f);
    }
  }
}

// The old header: the 20 bytes of DX10 cut out, a Direct3D 9 format number in the place of "DX10".
Bytes legacy(const Bytes& bytes, std::uint32_t fourcc) {
  Bytes old = with32(bytes, 84, fourcc);
  old.erase(old.begin() + 128, old.begin() + 148);
  return old;
}

TEST(Dds, OldFloatFormatsAreRead) {
  const std::vector<std::pair<PixelFormat, std::uint32_t>> formats = {{PixelFormat::rgba16f, 113},
                                                                      {PixelFormat::rgba32f, 116},
                                                                      {PixelFormat::rg16f, 112},
                                                                      {PixelFormat::rg32f, 115}};
  for (const auto& [format, fourcc] : formats) {
    DdsOptions options;
    options.format = format;
    const Bytes cube = encode_dds(test_cube(4, true), options).bytes;
    EXPECT_EQ(decode_dds(legacy(cube, fourcc), "a").cube.levels[1].texels,
              decode_dds(cube, "b").cube.levels[1].texels);
    const Bytes flat = encode_dds(test_image(3, 2), options).bytes;
    EXPECT_EQ(decode_dds(legacy(flat, fourcc), "a").flat.pixels, decode_dds(flat, "b").flat.pixels);
    expect_refused(with32(legacy(cube, fourcc), 112, 0x0600), "all six faces");
    expect_refused(with32(legacy(flat, fourcc), 112, 0x200000), "volume");
  }
  expect_refused(legacy(encode_dds(test_image(3, 2)).bytes, 0x31545844), "pixel format");  // DXT1
  expect_refused(legacy(encode_dds(test_image(3, 2)).bytes, 0), "pixel format");
}

TEST(Dds, EveryPrefixIsRefused) {
  const Bytes cube = encode_dds(test_cube(4, true)).bytes;
  const Bytes flat = encode_dds(test_image(5, 3)).bytes;
  for (const Bytes& bytes : {cube, flat, legacy(cube, 113), legacy(flat, 113)}) {
    expect_every_prefix_refused(bytes, "small.dds", decode);
  }
}

TEST(Dds, WrongHeaderFields) {
  const Bytes good = encode_dds(test_cube(4, true)).bytes;
  expect_refused(with32(good, 0, 0x21534444), "not a DDS");
  expect_refused(with32(good, 4, 100), "damaged");
  expect_refused(with32(good, 76, 31), "damaged");
  expect_refused(with32(good, 12, 0), "not square");
  expect_refused(with32(with32(good, 12, 0), 16, 0), "no pixels");
  expect_refused(with32(with32(good, 12, 100000), 16, 100000), "100000");
  expect_refused(with32(with32(good, 12, 0xffffffff), 16, 0xffffffff), "4294967295");
  expect_refused(with32(with32(good, 12, 5), 16, 5), "cannot hold");
  expect_refused(with32(encode_dds(test_cube(4, false)).bytes, 28, 2), "pixels are missing");
  expect_refused(with32(good, 28, 4), "mip levels");
  expect_refused(with32(good, 28, 200), "mip levels");
  expect_refused(with32(good, 128, 28), "DXGI format 28");  // R8G8B8A8_UNORM
  expect_refused(with32(good, 128, 2), "cannot hold");      // R32G32B32A32_FLOAT
  expect_refused(with32(good, 132, 4), "2-D");              // 3-D
  expect_refused(with32(good, 140, 2), "arrays");
}

TEST(Dds, RandomBytesNeverCrash) {
  std::mt19937 random(23);
  const Bytes cube = encode_dds(test_cube(4, true)).bytes;
  for (const Bytes& good : {cube, legacy(cube, 113), encode_dds(test_image(5, 3)).bytes}) {
    for (int i = 0; i < 4000; ++i) {
      Bytes bad = good;
      for (int flips = 0; flips < 1 + i % 3; ++flips)
        bad[random() % 148] = static_cast<std::uint8_t>(random());
      const std::string message = refusal(bad, decode);
      ASSERT_TRUE(message == "(accepted)" || message.starts_with("small.dds: ")) << message;
    }
  }
}

TEST(Dds, BadInputsAreRefused) {
  EXPECT_THROW(encode_dds(Image{}), Error);
  EXPECT_THROW(encode_dds(CubeMips{}), Error);
  DdsOptions options;
  options.stored_scale = 3;
  EXPECT_THROW(encode_dds(test_image(1, 1), options), Error);
}

}  // namespace
}  // namespace welkin
