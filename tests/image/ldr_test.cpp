#include <welkin/image/codecs/ldr.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include <tests/image/ldr_files.h>
#include <tests/image/prefixes.h>
#include <welkin/image/srgb.h>

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

void decode(std::span<const std::uint8_t> bytes) { decode_ldr(bytes, "test"); }

std::string ldr_refusal(const Bytes& bytes) { return refusal(bytes, decode); }

float linear(double encoded) { return static_cast<float>(srgb_to_linear(encoded)); }

// Any number of the form's bits, alike in no two neighbours or channels.
int stored(const PngForm& form, int x, int y, int c) {
  return (x * 2311 + y * 7919 + c * 971) % (1 << form.bits);
}

Bytes png_of(const PngForm& form) {
  return png_file(form, [&](int x, int y, int c) { return stored(form, x, y, c); });
}

// One palette entry for each number that a pixel can have.
std::vector<std::array<std::uint8_t, 3>> full_palette(int bits) {
  std::vector<std::array<std::uint8_t, 3>> palette;
  for (int i = 0; i < 1 << bits; ++i) {
    palette.push_back(
        {static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(i * 5), static_cast<std::uint8_t>(i)});
  }
  return palette;
}

// Every pair of colour type and depth that PNG has.
std::vector<PngForm> all_forms() {
  std::vector<PngForm> forms;
  for (int bits : {1, 2, 4, 8, 16}) {
    forms.push_back({.color = PngColor::gray, .bits = bits});
    if (bits <= 8) forms.push_back({.color = PngColor::palette, .bits = bits, .palette = full_palette(bits)});
    if (bits < 8) continue;
    for (PngColor color : {PngColor::rgb, PngColor::gray_alpha, PngColor::rgba}) {
      forms.push_back({.color = color, .bits = bits});
    }
  }
  return forms;
}

std::string words(const PngForm& form) {
  return "colour type " + std::to_string(static_cast<int>(form.color)) + ", " + std::to_string(form.bits) +
         " bits" + (form.interlaced ? ", interlaced" : "") + (form.transparent_color ? ", tRNS" : "") +
         (form.ancillary ? ", gAMA" : "");
}

float expected(const PngForm& form, int x, int y, int c) {
  if (form.color == PngColor::palette) {
    return linear(form.palette[static_cast<std::size_t>(stored(form, x, y, 0))][static_cast<std::size_t>(c)] /
                  255.0);
  }
  const int channel = channel_count(form.color) < 3 ? 0 : c;
  return linear(stored(form, x, y, channel) / ((1 << form.bits) - 1.0));
}

void expect_exact(const PngForm& form) {
  const Image image = decode_ldr(png_of(form), "test").flat;
  ASSERT_EQ(image.width, form.width) << words(form);
  ASSERT_EQ(image.height, form.height) << words(form);
  for (int i = 0; i < form.width * form.height * 3; ++i) {
    const int x = i / 3 % form.width, y = i / 3 / form.width;
    ASSERT_EQ(image.pixels[static_cast<std::size_t>(i)], expected(form, x, y, i % 3))
        << words(form) << " at " << x << ", " << y << ", " << i % 3;
  }
}

TEST(Png, EveryFormIsExact) {
  for (PngForm form : all_forms()) {
    for (bool interlaced : {false, true}) {
      form.interlaced = interlaced;
      expect_exact(form);
    }
  }
}

// Alpha and transparent colours are dropped, and gamma is not applied: the pixels are those of the plain file.
TEST(Png, WhatMayBeLeftOutChangesNothing) {
  for (PngForm form : all_forms()) {
    form.ancillary = true;
    form.transparent_color = form.color != PngColor::gray_alpha && form.color != PngColor::rgba;
    expect_exact(form);
  }
}

// Sizes at which passes of an interlaced file are empty.
TEST(Png, SmallInterlacedFilesAreExact) {
  for (int width = 1; width <= 9; ++width) {
    for (int height = 1; height <= 9; ++height) {
      expect_exact(
          {.width = width, .height = height, .color = PngColor::gray, .bits = 1, .interlaced = true});
      expect_exact({.width = width, .height = height, .color = PngColor::rgb, .interlaced = true});
    }
  }
}

TEST(Png, SaysWhatItIs) {
  const LoadedImage loaded = decode_ldr(png_of({}), "test");
  EXPECT_EQ(loaded.format, "PNG");
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{"PNG is not HDR: light above white is lost"}));
}

TEST(Png, OurOwnFilesComeBack) {
  ByteImage image(64, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(i);
  const Image read = decode_ldr(encode_png(image), "test").flat;
  ASSERT_EQ(read.width, 64);
  for (std::size_t i = 0; i < read.pixels.size(); ++i)
    EXPECT_EQ(read.pixels[i], linear(static_cast<double>(i % 256) / 255));
  ByteImage gray(2, 1, 1);
  gray.pixels = {0, 255};
  EXPECT_EQ(decode_ldr(encode_png(gray), "test").flat.pixels, (std::vector<float>{0, 0, 0, 1, 1, 1}));
}

TEST(Png, EveryPrefixIsRefused) {
  for (PngForm form : all_forms()) {
    form.interlaced = form.bits % 8 != 0;
    expect_every_prefix_refused(png_of(form), "test", decode);
  }
}

// Check sums cover every byte but those of the signature and of the chunks' lengths, which then lead astray.
TEST(Png, EveryFlippedBitIsRefused) {
  const Bytes bytes =
      png_of({.color = PngColor::palette, .bits = 2, .ancillary = true, .palette = full_palette(2)});
  for (std::size_t i = 0; i < bytes.size() * 8; ++i) {
    Bytes damaged = bytes;
    damaged[i / 8] = static_cast<std::uint8_t>(damaged[i / 8] ^ 1 << i % 8);
    const std::string message = ldr_refusal(damaged);
    ASSERT_TRUE(message.starts_with("test: ")) << i / 8 << ": " << message;
    ASSERT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Png, PixelsOutsideThePaletteAreRefused) {
  PngForm form{.color = PngColor::palette, .bits = 8, .palette = full_palette(8)};
  form.palette.resize(200);
  for (bool interlaced : {false, true}) {
    form.interlaced = interlaced;
    EXPECT_NE(ldr_refusal(png_of(form)).find("palette"), std::string::npos);
    EXPECT_EQ(refusal(png_file(form, [](int x, int y, int) { return (x * y) % 200; }), decode), "(accepted)");
  }
}

std::uint32_t png_check_sum(std::span<const std::uint8_t> bytes) {
  std::uint32_t sum = ~0u;
  for (std::uint8_t byte : bytes) {
    sum ^= byte;
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
  }
  return ~sum;
}

// Width and height of the header replaced and its check sum made right again.
Bytes resized(Bytes bytes, std::uint32_t width, std::uint32_t height) {
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
  };
  put(16, width);
  put(20, height);
  put(29, png_check_sum(std::span(bytes).subspan(12, 17)));
  return bytes;
}

TEST(Png, SizesThatTheFileCannotHoldAreRefused) {
  const Bytes bytes = png_of({.color = PngColor::gray, .bits = 1});
  ASSERT_EQ(ldr_refusal(resized(bytes, 13, 11)), "(accepted)");
  EXPECT_NE(ldr_refusal(resized(bytes, 20000, 20000)).find("cannot hold"), std::string::npos);
  EXPECT_NE(ldr_refusal(resized(bytes, 100000, 100000)).find("at most"), std::string::npos);
  EXPECT_NE(ldr_refusal(resized(bytes, 1000001, 1)), "(accepted)");
  EXPECT_NE(ldr_refusal(resized(bytes, 0, 11)), "(accepted)");
  EXPECT_NE(ldr_refusal(resized(bytes, 13, 12)).find("PNG"), std::string::npos);  // one row too few
  EXPECT_NE(ldr_refusal(resized(bytes, 13, 10)).find("PNG"), std::string::npos);  // one row too many
}

// A chunk of a gigabyte in a small file. The first one behind the header begins at 33.
TEST(Png, ChunksLargerThanTheFileAreRefused) {
  Bytes bytes = png_of({.ancillary = true});
  bytes[33] = 0x3f;
  EXPECT_NE(ldr_refusal(bytes).find("cut off"), std::string::npos);
}

ByteImage smooth_picture(int channels) {
  ByteImage image(37, 29, channels);
  for (int i = 0; i < 37 * 29 * channels; ++i) {
    const int x = i / channels % 37, y = i / channels / 37, c = i % channels;
    image.pixels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(40 + 3 * x + 2 * y + 10 * c);
  }
  return image;
}

// A constant block has only its mean, which level shift and quantizer 1 keep: 128 is coded as 0.
// Alpha as stored, colour as stored or through the curve.
TEST(Png, TexturesKeepTheirAlpha) {
  for (const PngForm& form :
       {PngForm{.color = PngColor::rgba}, PngForm{.color = PngColor::rgba, .bits = 16}}) {
    const float largest = static_cast<float>((1 << form.bits) - 1);
    const Image plain = decode_ldr_texture(png_of(form), "test", LdrEncoding::linear);
    const Image curved = decode_ldr_texture(png_of(form), "test", LdrEncoding::srgb);
    ASSERT_EQ(plain.channels, 4);
    for (int i = 0; i < form.width * form.height * 4; ++i) {
      const int x = i / 4 % form.width, y = i / 4 / form.width, c = i % 4;
      const float value = static_cast<float>(stored(form, x, y, c)) / largest;
      ASSERT_EQ(plain.pixels[i], value) << words(form);
      ASSERT_EQ(curved.pixels[i], c == 3 ? value : expected(form, x, y, c)) << words(form);
    }
  }
}

TEST(Png, TexturesTakeAlphaFromPalettesAndTransparentColours) {
  const PngForm palette{.color = PngColor::palette, .transparent_color = true, .palette = full_palette(8)};
  const Image looked_up = decode_ldr_texture(png_of(palette), "test", LdrEncoding::srgb);
  ASSERT_EQ(looked_up.channels, 4);
  EXPECT_EQ(looked_up.at(3, 4)[1], expected(palette, 3, 4, 1));
  EXPECT_EQ(looked_up.at(3, 4)[3], 7.0f / 255);
  const PngForm gray{.color = PngColor::gray, .transparent_color = true};  // 0 is transparent
  const Image keyed = decode_ldr_texture(png_of(gray), "test", LdrEncoding::linear);
  ASSERT_EQ(keyed.channels, 4);
  for (int x = 0; x < 13; ++x) EXPECT_EQ(keyed.at(x, 0)[3], stored(gray, x, 0, 0) == 0 ? 0.0f : 1.0f);
  EXPECT_EQ(decode_ldr_texture(png_of({}), "test", LdrEncoding::linear).channels, 3);
}

TEST(Jpeg, ConstantGrayIsExact) {
  ByteImage image(16, 16);
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{128});
  const LoadedImage loaded = decode_ldr(jpeg_file(image, {.quality = 100}), "test");
  ASSERT_EQ(loaded.flat.width, 16);
  for (float value : loaded.flat.pixels) EXPECT_FLOAT_EQ(value, linear(128 / 255.0));
  EXPECT_EQ(loaded.format, "JPEG");
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{"JPEG is not HDR: light above white is lost"}));
}

// Of a ramp, at quality 100, rounding of the colours and halved chroma at the edges leave a few steps of 255.
TEST(Jpeg, EverySubsamplingComesBackClosely) {
  for (int channels : {1, 3}) {
    const ByteImage picture = smooth_picture(channels);
    for (int subsampling : {TJSAMP_444, TJSAMP_422, TJSAMP_420, TJSAMP_440, TJSAMP_411}) {
      for (bool progressive : {false, true}) {
        const Image image =
            decode_ldr(
                jpeg_file(picture, {.subsampling = subsampling, .quality = 100, .progressive = progressive}),
                "test")
                .flat;
        ASSERT_EQ(image.pixels.size(), std::size_t{37} * 29 * 3);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
          const int stored = picture.pixels[channels == 1 ? i / 3 : i];
          ASSERT_NEAR(linear_to_srgb(static_cast<double>(image.pixels[i])) * 255, stored, 4)
              << subsampling << (progressive ? " progressive " : " ") << i;
        }
      }
    }
  }
}

TEST(Jpeg, EveryPrefixIsRefused) {
  for (int channels : {1, 3}) {
    for (bool progressive : {false, true}) {
      expect_every_prefix_refused(
          jpeg_file(smooth_picture(channels), {.quality = 60, .progressive = progressive}), "test", decode);
    }
  }
}

// JPEG has no check sums, so damage can look like a picture; but nothing other than a picture or an Error may come out.
TEST(Jpeg, DamagedFilesGiveAPictureOrAnError) {
  for (bool progressive : {false, true}) {
    const Bytes bytes = jpeg_file(smooth_picture(3), {.quality = 60, .progressive = progressive});
    int refused = 0;
    for (std::size_t i = 3; i < bytes.size(); ++i) {
      Bytes damaged = bytes;
      damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ 0xff);
      const std::string message = ldr_refusal(damaged);
      refused += message != "(accepted)";
      ASSERT_TRUE(message == "(accepted)" || message.starts_with("test: ")) << i << ": " << message;
    }
    EXPECT_GT(refused, 20);
  }
}

TEST(Jpeg, PrintColoursAreRefused) {
  EXPECT_EQ(ldr_refusal(cmyk_jpeg_file()), "test: this JPEG is for print (CMYK); convert it to RGB first");
}

// Position of the height in the frame header: marker, two bytes of length, the precision.
std::size_t height_position(const Bytes& bytes, std::uint8_t frame_marker) {
  std::size_t at = 2;
  while (at + 4 < bytes.size() && bytes[at + 1] != frame_marker)
    at += 2u + (bytes[at + 2] << 8 | bytes[at + 3]);
  return at + 5;
}

TEST(Jpeg, SizesThatTheFileCannotHoldAreRefused) {
  Bytes bytes = jpeg_file(smooth_picture(3));
  const std::size_t at = height_position(bytes, 0xc0);
  ASSERT_EQ(bytes.at(at + 1), 29);
  bytes[at + 1] = 100;  // more rows than there are: the data ends too early
  EXPECT_NE(ldr_refusal(bytes).find("JPEG"), std::string::npos);
  bytes[at] = bytes[at + 2] = 0x40;
  EXPECT_NE(ldr_refusal(bytes).find("cannot hold"), std::string::npos);
}

// A progressive file may name the same coefficients in any number of scans, each worked off over the whole picture.
TEST(Jpeg, EndlessScansAreRefused) {
  Bytes bytes = jpeg_file(smooth_picture(3), {.progressive = true});
  std::size_t scan = height_position(bytes, 0xda) - 5;
  const std::size_t length = 2u + (bytes.at(scan + 2) << 8 | bytes.at(scan + 3));
  std::size_t end = scan + length;
  while (!(bytes.at(end) == 0xff && bytes.at(end + 1) != 0)) ++end;
  const Bytes one(bytes.begin() + static_cast<std::ptrdiff_t>(scan),
                  bytes.begin() + static_cast<std::ptrdiff_t>(end));
  Bytes many(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(scan));
  for (int i = 0; i < 1000; ++i) many.insert(many.end(), one.begin(), one.end());
  many.insert(many.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end());
  EXPECT_NE(ldr_refusal(many), "(accepted)");
}

TEST(Ldr, OtherFormatsAreRefused) {
  EXPECT_EQ(ldr_refusal({'B', 'M', 0, 0}), "test: neither a PNG nor a JPEG file");
}

}  // namespace
}  // namespace welkin
