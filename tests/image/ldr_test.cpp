#include <welkin/image/codecs/ldr.h>

#include <gtest/gtest.h>
#include <stb_image_write.h>

#include <cmath>
#include <string>

#include <tests/image/prefixes.h>
#include <welkin/image/srgb.h>

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

// One pixel of 16-bit RGBA, 0x8000 0xffff 0x0000 with alpha 0x1234, in a stored deflate block.
const Bytes rgba16{0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49,
                   0x48, 0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x10, 0x06,
                   0x00, 0x00, 0x00, 0x4f, 0x85, 0x18, 0xca, 0x00, 0x00, 0x00, 0x14, 0x49, 0x44,
                   0x41, 0x54, 0x78, 0x01, 0x01, 0x09, 0x00, 0xf6, 0xff, 0x00, 0x80, 0x00, 0xff,
                   0xff, 0x00, 0x00, 0x12, 0x34, 0x0f, 0x56, 0x02, 0xc5, 0xc6, 0x95, 0xfb, 0xd4,
                   0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

// 3 x 2 pixels of 1-bit gray: 1 0 1 above 0 1 0.
const Bytes gray1{0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
                  0x52, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x02, 0x01, 0x00, 0x00, 0x00, 0x00, 0xb5,
                  0x0f, 0x5b, 0xb7, 0x00, 0x00, 0x00, 0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0x01, 0x01, 0x04,
                  0x00, 0xfb, 0xff, 0x00, 0xa0, 0x00, 0x40, 0x02, 0x24, 0x00, 0xe1, 0x48, 0x5f, 0x24, 0x54,
                  0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

std::string ldr_refusal(const Bytes& bytes) {
  return refusal(bytes, [](std::span<const std::uint8_t> b) { decode_ldr(b, "test.png"); });
}

TEST(Png, SixteenBitsAreKeptAndAlphaIsDropped) {
  const LoadedImage loaded = decode_ldr(rgba16, "test.png");
  ASSERT_EQ(loaded.flat.pixels.size(), 3u);
  EXPECT_FLOAT_EQ(loaded.flat.pixels[0], static_cast<float>(srgb_to_linear(0x8000 / 65535.0)));
  EXPECT_EQ(loaded.flat.pixels[1], 1);
  EXPECT_EQ(loaded.flat.pixels[2], 0);
  EXPECT_EQ(loaded.format, "PNG");
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{"PNG is not HDR: light above white is lost"}));
}

TEST(Png, OneBitGrayBecomesRgb) {
  EXPECT_EQ(decode_ldr(gray1, "test.png").flat.pixels,
            (std::vector<float>{1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0}));
}

TEST(Png, EveryByteComesBackThroughTheSrgbCurve) {
  ByteImage image(64, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i);
  const LoadedImage loaded = decode_ldr(encode_png(image), "test.png");
  ASSERT_EQ(loaded.flat.width, 64);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_FLOAT_EQ(loaded.flat.pixels[i],
                    static_cast<float>(srgb_to_linear(static_cast<double>(i % 256) / 255)));
  }
}

TEST(Png, GrayIsEncoded) {
  ByteImage image(2, 1, 1);
  image.pixels = {0, 255};
  EXPECT_EQ(decode_ldr(encode_png(image), "test.png").flat.pixels, (std::vector<float>{0, 0, 0, 1, 1, 1}));
}

Bytes jpeg_file() {
  const Bytes pixels(16 * 16 * 3, 128);
  Bytes bytes;
  stbi_write_jpg_to_func(
      [](void* context, void* data, int count) {
        const auto* begin = static_cast<const std::uint8_t*>(data);
        static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), begin, begin + count);
      },
      &bytes, 16, 16, 3, pixels.data(), 100);
  return bytes;
}

// A constant block has only its mean, which level shift and quantizer 1 keep: 128 is coded as 0.
TEST(Jpeg, ConstantGrayIsExact) {
  const LoadedImage loaded = decode_ldr(jpeg_file(), "test.jpg");
  ASSERT_EQ(loaded.flat.width, 16);
  for (float value : loaded.flat.pixels)
    EXPECT_FLOAT_EQ(value, static_cast<float>(srgb_to_linear(128 / 255.0)));
  EXPECT_EQ(loaded.format, "JPEG");
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(Ldr, EveryPrefixIsRefused) {
  const auto decode = [](std::span<const std::uint8_t> b) { decode_ldr(b, "test.png"); };
  expect_every_prefix_refused(jpeg_file(), "test.png", decode);
  expect_every_prefix_refused(gray1, "test.png", decode);
  expect_every_prefix_refused(rgba16, "test.png", decode);
}

// A chunk of a gigabyte in a file of 72 bytes. The data chunk begins at 33.
TEST(Ldr, ChunksLargerThanTheFileAreRefused) {
  Bytes bytes = gray1;
  bytes[33] = 0x3f;
  EXPECT_NE(ldr_refusal(bytes).find("chunks"), std::string::npos);
}

TEST(Ldr, OtherFormatsAndSizesAreRefused) {
  EXPECT_EQ(ldr_refusal({'B', 'M', 0, 0}), "test.png: neither a PNG nor a JPEG file");
  Bytes huge = gray1;
  for (std::size_t at : {16, 20}) huge[at + 1] = 0x01, huge[at + 2] = 0x86, huge[at + 3] = 0xa0;  // 100,000
  EXPECT_NE(ldr_refusal(huge), "(accepted)");
  for (std::size_t at : {16, 20}) huge[at + 1] = 0x00, huge[at + 2] = 0x4e, huge[at + 3] = 0x20;  // 20,000
  EXPECT_NE(ldr_refusal(huge).find("cannot hold"), std::string::npos);
  for (std::size_t at : {16, 20}) huge[at + 2] = huge[at + 3] = 0;
  EXPECT_NE(ldr_refusal(huge), "(accepted)");
}

}  // namespace
}  // namespace welkin
