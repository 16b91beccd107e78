#include <welkin/image/codecs/hdr.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <tests/image/prefixes.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes hdr_file(const std::string& header, const Bytes& pixels) {
  Bytes bytes(header.begin(), header.end());
  bytes.insert(bytes.end(), pixels.begin(), pixels.end());
  return bytes;
}

Bytes rgbe_file(const std::string& resolution, const Bytes& pixels, const std::string& variables = "") {
  return hdr_file("#?RADIANCE\n" + variables + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n", pixels);
}

std::vector<float> pixels_of(const Bytes& bytes) { return decode_hdr(bytes, "test.hdr").pixels; }

std::string hdr_refusal(const Bytes& bytes) {
  return refusal(bytes, [](std::span<const std::uint8_t> b) { decode_hdr(b, "test.hdr"); });
}

// Exponent 136 is 2^0: the mantissas are the values. 129 is 2^-7: mantissa 128 is 1. Exponent 0 is black.
TEST(Hdr, FlatPixelsAreMantissaTimesPowerOfTwo) {
  const Bytes bytes = rgbe_file("-Y 1 +X 3", {10, 20, 30, 136, 128, 64, 0, 129, 99, 98, 97, 0});
  EXPECT_EQ(pixels_of(bytes), (std::vector<float>{10, 20, 30, 1, 0.5f, 0, 0, 0, 0}));
}

TEST(Hdr, ExtremeExponents) {
  const Bytes bytes = rgbe_file("-Y 1 +X 2", {255, 128, 1, 255, 255, 1, 0, 1});
  EXPECT_EQ(pixels_of(bytes),
            (std::vector<float>{255 * 0x1p119f, 0x1p126f, 0x1p119f, 255 * 0x1p-135f, 0x1p-135f, 0}));
}

// (1,1,1,n) repeats the pixel before it n times; directly after another one it counts n << 8 more.
TEST(Hdr, OldRunLengthsRepeatAndShift) {
  Bytes run{7, 8, 9, 136, 1, 1, 1, 2, 1, 1, 1, 1, 5, 5, 5, 136, 1, 1, 1, 1};
  const int width = 1 + 2 + 256 + 1 + 1;
  const Image image = decode_hdr(rgbe_file("-Y 1 +X " + std::to_string(width), run), "test.hdr");
  ASSERT_EQ(image.width, width);
  for (int x = 0; x < width; ++x) {
    ASSERT_EQ(image.at(x, 0)[0], x < 259 ? 7 : 5) << x;
    ASSERT_EQ(image.at(x, 0)[2], x < 259 ? 9 : 5) << x;
  }
}

// Nine pixels: r = 1..9 literal; g = nine times 4; b = eight times 6, then 2; e = nine times 136.
const Bytes new_line{2, 2, 0, 9, 9, 1, 2, 3, 4, 5, 6, 7, 8, 9, 137, 4, 136, 6, 1, 2, 137, 136};

TEST(Hdr, NewRunLengths) {
  const Image image = decode_hdr(rgbe_file("-Y 1 +X 9", new_line), "test.hdr");
  for (int x = 0; x < 9; ++x) {
    EXPECT_EQ(image.at(x, 0)[0], x + 1);
    EXPECT_EQ(image.at(x, 0)[1], 4);
    EXPECT_EQ(image.at(x, 0)[2], x < 8 ? 6 : 2);
  }
}

TEST(Hdr, ScanLinesOfAllFormsInOneFile) {
  Bytes pixels = new_line;
  for (int x = 0; x < 9; ++x)
    pixels.insert(pixels.end(), {2, 2, 200, 136});  // flat, although it begins with 2 2
  pixels.insert(pixels.end(), {30, 31, 32, 136, 1, 1, 1, 8});
  pixels.insert(pixels.end(), new_line.begin(), new_line.end());
  const Image image = decode_hdr(rgbe_file("-Y 4 +X 9", pixels), "test.hdr");
  EXPECT_EQ(image.at(8, 0)[0], 9);
  EXPECT_EQ(image.at(8, 1)[2], 200);
  EXPECT_EQ(image.at(8, 2)[1], 31);
  EXPECT_EQ(image.at(8, 3)[2], 2);
}

TEST(Hdr, ExposureAndColourCorrectionAreDividedOut) {
  const std::string variables = "EXPOSURE=2\nEXPOSURE= 0.25\nCOLORCORR= 1 2 4\n\tEXPOSURE=1000\n";
  const Bytes bytes = rgbe_file("-Y 1 +X 1", {16, 16, 16, 136}, variables);
  EXPECT_EQ(pixels_of(bytes), (std::vector<float>{32, 16, 8}));
}

TEST(Hdr, WindowsLineEndsAndOtherPrograms) {
  EXPECT_EQ(pixels_of(hdr_file("#?RGBE\r\nSOFTWARE=x\r\n\r\n-Y 1 +X 1\r\n", {1, 2, 3, 136})),
            (std::vector<float>{1, 2, 3}));
}

// The XYZ of the D65 white (x 0.3127, y 0.3290) is (0.9505, 1, 1.0891): here 243, 256, 279 as mantissas of 2^-8. They
// are rounded, which the matrix (entries up to 3.2) makes 3.2 * 0.5 / 128 at most; with exponent 137 twice 2^0 = 1.
TEST(Hdr, XyzeWhiteIsWhite) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n";
  const std::vector<float> pixel = pixels_of(hdr_file(header, {122, 128, 139, 129}));
  for (float value : pixel) EXPECT_NEAR(value, 1, 0.0126);
  const std::vector<float> y_only = pixels_of(hdr_file(header, {0, 128, 0, 129}));
  EXPECT_NEAR(y_only[0], -1.5374, 1e-3);  // BT.709 from XYZ, second column, to the digits given here
  EXPECT_NEAR(y_only[1], 1.8760, 1e-3);
  EXPECT_NEAR(y_only[2], -0.2040, 1e-3);
}

// The picture, as it should be seen:  1 2 3
//                                     4 5 6
TEST(Hdr, AllEightOrientations) {
  const std::vector<std::pair<std::string, std::vector<int>>> cases{
      {"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}}, {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}}, {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}},
      {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}}, {"+X 3 -Y 2", {1, 4, 2, 5, 3, 6}}, {"-X 3 -Y 2", {3, 6, 2, 5, 1, 4}},
      {"+X 3 +Y 2", {4, 1, 5, 2, 6, 3}}, {"-X 3 +Y 2", {6, 3, 5, 2, 4, 1}}};
  for (const auto& [resolution, order] : cases) {
    Bytes pixels;
    for (int value : order) pixels.insert(pixels.end(), {static_cast<std::uint8_t>(value), 0, 0, 136});
    const Image image = decode_hdr(rgbe_file(resolution, pixels), "test.hdr");
    ASSERT_EQ(image.width, 3) << resolution;
    ASSERT_EQ(image.height, 2) << resolution;
    for (int i = 0; i < 6; ++i) EXPECT_EQ(image.at(i % 3, i / 3)[0], i + 1) << resolution << " " << i;
  }
}

TEST(Hdr, DamagedFilesAreRefused) {
  EXPECT_EQ(hdr_refusal(hdr_file("P6 1 1 255\n", {})),
            "test.hdr: not a Radiance picture: it does not begin with #?");
  const Bytes four(4, 136);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 0 +X 1", four)).find("no pixels"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X -5", four)).find("no pixels"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 100000 +X 100000", four)).find("at most"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 20000 +X 100000", four)).find("cannot hold"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +Y 1", four)).find("resolution"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X nan", four)).find("resolution"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X 1", four, "EXPOSURE=0\n")).find("EXPOSURE"), std::string::npos);
  EXPECT_NE(hdr_refusal(hdr_file("#?RADIANCE\nFORMAT=ascii\n\n-Y 1 +X 1\n", four)).find("format"),
            std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X 2", {1, 1, 1, 2})).find("no pixel to repeat"), std::string::npos);
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X 2", {9, 9, 9, 136, 1, 1, 1, 2})).find("leaves"),
            std::string::npos);
  Bytes wrong_length = new_line;
  wrong_length[3] = 10;
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X 9", wrong_length)).find("length"), std::string::npos);
  Bytes long_run = new_line;
  long_run[4 + 10] = 138;
  EXPECT_NE(hdr_refusal(rgbe_file("-Y 1 +X 9", long_run)).find("leaves"), std::string::npos);
}

TEST(Hdr, EveryPrefixIsRefused) {
  Bytes pixels = new_line;
  for (int x = 0; x < 9; ++x) pixels.insert(pixels.end(), {5, 6, 7, 136});
  const auto decode = [](std::span<const std::uint8_t> b) { decode_hdr(b, "test.hdr"); };
  expect_every_prefix_refused(rgbe_file("-Y 2 +X 9", pixels, "EXPOSURE=2\n"), "test.hdr", decode);
}

Image random_image(int width, int height) {
  Image image(width, height);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> stops(-30, 30);
  for (float& value : image.pixels) value = std::exp2(stops(random));
  for (int x = 0; x < width / 2; ++x)
    std::fill_n(image.at(x, height / 2), 3, 0.75f);  // something to run over
  return image;
}

// Rounding to nearest: half a step of the shared exponent, whose largest mantissa is at least 127.5 steps.
TEST(Hdr, RoundTripIsWithinHalfAStepOfTheLargestComponent) {
  for (int width : {1, 7, 8, 300, 32767, 32768}) {
    const Image image = random_image(width, 2);
    const Image back = decode_hdr(encode_hdr(image), "test.hdr");
    ASSERT_EQ(back.width, width);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
      const float* p = image.pixels.data() + i;
      const double top = std::max({p[0], p[1], p[2]});
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(back.pixels[i + c], p[c], top / 255) << width << " " << i;
    }
  }
}

TEST(Hdr, WhatRgbeCanHoldComesBackExactly) {
  Image image(300, 3);
  std::mt19937 random(2);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    const int exponent = static_cast<int>(random() % 254) - 126;
    image.pixels[i] = std::ldexp(static_cast<float>(128 + random() % 128), exponent - 8);
    image.pixels[i + 1] = std::ldexp(static_cast<float>(random() % 256), exponent - 8);
  }
  EXPECT_EQ(decode_hdr(encode_hdr(image), "test.hdr").pixels, image.pixels);
}

TEST(Hdr, EncoderRoundsSaturatesAndDropsWhatItCannotHold) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Image image(6, 1);
  image.pixels = {255.75f / 256, 0, 0,   // rounds to 256/256, so the next exponent
                  infinity,      1, -1,  // saturates
                  std::nanf(""), 2, 4,   //
                  0x1p-128f,     0, 0,   // the smallest normal pixel
                  0x1.8p-129f,   0, 0,   // below it
                  3.4e38f,       0, 0};
  const float top = 255 * 0x1p119f;
  EXPECT_EQ(decode_hdr(encode_hdr(image), "test.hdr").pixels,
            (std::vector<float>{1, 0, 0, top, 0, 0, 0, 2, 4, 0x1p-128f, 0, 0, 0, 0, 0, top, 0, 0}));
}

TEST(Hdr, GrayBecomesRgb) {
  Image gray(1, 1, 1);
  gray.pixels = {0.5f};
  EXPECT_EQ(decode_hdr(encode_hdr(gray), "test.hdr").pixels, (std::vector<float>{0.5f, 0.5f, 0.5f}));
}

// Three equal rows of 200 equal pixels: a marker and twice four packets (127 and 73 repeats) of two bytes each.
TEST(Hdr, RunsAreCompressed) {
  Image image(200, 3);
  std::fill(image.pixels.begin(), image.pixels.end(), 1.0f);
  const Bytes bytes = encode_hdr(image);
  const std::string header = "-Y 3 +X 200\n";
  const auto pixels = std::search(bytes.begin(), bytes.end(), header.begin(), header.end()) + header.size();
  EXPECT_EQ(bytes.end() - pixels, 3 * (4 + 4 * 2 * 2));
}

TEST(Hdr, SameBytesOnAnyNumberOfThreads) {
  const Image image = random_image(64, 100);
  set_thread_count(1);
  const Bytes expected = encode_hdr(image);
  const Image decoded = decode_hdr(expected, "test.hdr");
  for (int threads : {2, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(encode_hdr(image), expected);
    EXPECT_EQ(decode_hdr(expected, "test.hdr").pixels, decoded.pixels);
  }
  set_thread_count(0);
}

}  // namespace
}  // namespace welkin
