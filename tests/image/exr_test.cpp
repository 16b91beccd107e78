#include <welkin/image/codecs/exr.h>

#include <ImfChromaticities.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfPreviewImage.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <tests/image/exr_files.h>
#include <tests/image/prefixes.h>

namespace welkin {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Small integers, exact in half, uint and float alike, different for every pixel and channel.
float red(int x, int y) { return static_cast<float>(x + 16 * y + 256); }
float green(int x, int y) { return static_cast<float>(x + 16 * y + 512); }
float blue(int x, int y) { return static_cast<float>(x + 16 * y + 1024); }

std::vector<ExrChannel> rgb_channels(Imf::PixelType type, const std::string& prefix = "") {
  return {{prefix + "R", red, type}, {prefix + "G", green, type}, {prefix + "B", blue, type}};
}

LoadedImage decode(const Bytes& bytes) { return decode_exr(bytes, "test.exr"); }

LoadedImage decode(const ExrForm& form, const std::vector<ExrChannel>& channels) {
  return decode(exr_file(exr_header(form, channels), channels));
}

std::string exr_refusal(const Bytes& bytes) {
  return refusal(bytes, [](std::span<const std::uint8_t> b) { decode_exr(b, "test.exr"); });
}

void expect_rgb(const Image& image, int left, int top, int width, int height) {
  ASSERT_EQ(image.width, width);
  ASSERT_EQ(image.height, height);
  ASSERT_EQ(image.channels, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      ASSERT_EQ(image.at(x, y)[0], red(left + x, top + y)) << x << " " << y;
      ASSERT_EQ(image.at(x, y)[1], green(left + x, top + y)) << x << " " << y;
      ASSERT_EQ(image.at(x, y)[2], blue(left + x, top + y)) << x << " " << y;
    }
  }
}

TEST(Exr, ScanLinesOfEveryTypeAndLosslessCompression) {
  for (Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
    for (Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                         Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
      const LoadedImage loaded = decode({.compression = compression}, rgb_channels(type));
      expect_rgb(loaded.flat, 0, 0, 5, 4);
      EXPECT_TRUE(loaded.warnings.empty());
      EXPECT_EQ(loaded.format, "OpenEXR");
    }
  }
}

TEST(Exr, TilesThatDoNotDivideTheImageAndMipLevels) {
  for (bool mip_levels : {false, true}) {
    const ExrForm form{
        .data = {{0, 0}, {36, 20}}, .display = {{0, 0}, {36, 20}}, .tile = 16, .mip_levels = mip_levels};
    expect_rgb(decode(form, rgb_channels(Imf::HALF)).flat, 0, 0, 37, 21);
  }
}

TEST(Exr, WindowsThatDoNotBeginAtZero) {
  const Imath::Box2i window{{-7, 11}, {-3, 14}};
  expect_rgb(decode({.data = window, .display = window}, rgb_channels(Imf::FLOAT)).flat, -7, 11, 5, 4);
}

TEST(Exr, DataInsideTheDisplayWindowIsSurroundedByBlack) {
  const LoadedImage loaded =
      decode({.data = {{2, 1}, {4, 2}}, .display = {{0, 0}, {6, 3}}}, rgb_channels(Imf::HALF));
  ASSERT_EQ(loaded.flat.width, 7);
  ASSERT_EQ(loaded.flat.height, 4);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("black"), std::string::npos);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 7; ++x) {
      const bool inside = x >= 2 && x <= 4 && y >= 1 && y <= 2;
      EXPECT_EQ(loaded.flat.at(x, y)[1], inside ? green(x, y) : 0) << x << " " << y;
    }
  }
}

TEST(Exr, OverscanIsCropped) {
  for (int tile : {0, 2}) {
    const ExrForm form{.data = {{-3, -2}, {8, 9}}, .display = {{1, 2}, {4, 6}}, .tile = tile};
    const LoadedImage loaded = decode(form, rgb_channels(Imf::FLOAT));
    expect_rgb(loaded.flat, 1, 2, 4, 5);
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_NE(loaded.warnings[0].find("cropped"), std::string::npos);
  }
}

TEST(Exr, OverscanOnOneSideIsSaid) {
  const Imath::Box2i display{{0, 0}, {3, 3}};
  for (const Imath::Box2i& data : {Imath::Box2i{{-1, 0}, {3, 3}}, Imath::Box2i{{0, -1}, {3, 3}},
                                   Imath::Box2i{{0, 0}, {4, 3}}, Imath::Box2i{{0, 0}, {3, 4}}}) {
    const LoadedImage loaded = decode({.data = data, .display = display}, rgb_channels(Imf::HALF));
    expect_rgb(loaded.flat, 0, 0, 4, 4);
    EXPECT_EQ(loaded.warnings.size(), 1u);
  }
}

TEST(Exr, DataBesideTheDisplayWindowIsBlackWithBothWarnings) {
  const LoadedImage loaded =
      decode({.data = {{10, 10}, {12, 12}}, .display = {{0, 0}, {1, 1}}}, rgb_channels(Imf::HALF));
  EXPECT_EQ(loaded.flat.pixels, std::vector<float>(12));
  EXPECT_EQ(loaded.warnings.size(), 2u);
}

TEST(Exr, LuminanceAloneIsGray) {
  const LoadedImage loaded = decode({}, {{"Y", red, Imf::HALF}});
  for (int i = 0; i < 3; ++i) EXPECT_EQ(loaded.flat.at(3, 2)[i], red(3, 2));
}

// One colour (1, 2, 4) everywhere: Y = 0.212639 + 2 * 0.715169 + 4 * 0.072192 (Rec.709), so chroma is constant and
// interpolation exact; half floats of RY and BY are within 2^-11 relative.
TEST(Exr, LuminanceAndChroma) {
  const float y = 0.212639f * 1 + 0.715169f * 2 + 0.072192f * 4;
  const std::vector<ExrChannel> channels{{"Y", [=](int, int) { return y; }, Imf::FLOAT},
                                         {"RY", [=](int, int) { return (1 - y) / y; }, Imf::HALF, 2},
                                         {"BY", [=](int, int) { return (4 - y) / y; }, Imf::HALF, 2}};
  const LoadedImage loaded = decode({.data = {{2, -4}, {7, 3}}, .display = {{2, -4}, {7, 3}}}, channels);
  ASSERT_EQ(loaded.flat.width, 6);
  for (std::size_t i = 0; i < loaded.flat.pixels.size(); i += 3) {
    EXPECT_NEAR(loaded.flat.pixels[i], 1, 1e-3);
    EXPECT_NEAR(loaded.flat.pixels[i + 1], 2, 1e-3);
    EXPECT_NEAR(loaded.flat.pixels[i + 2], 4, 4e-3);
  }
}

// RY grows linearly along x; between the samples at even pixels it is interpolated, at the last one held.
TEST(Exr, ChromaIsInterpolated) {
  const std::vector<ExrChannel> channels{
      {"Y", [](int, int) { return 1.0f; }, Imf::FLOAT},
      {"RY", [](int x, int) { return static_cast<float>(x); }, Imf::FLOAT, 2},
      {"BY", [](int, int) { return 0.0f; }, Imf::FLOAT, 2}};
  const LoadedImage loaded = decode({.data = {{0, 0}, {5, 1}}, .display = {{0, 0}, {5, 1}}}, channels);
  for (int x = 0; x < 6; ++x)
    EXPECT_FLOAT_EQ(loaded.flat.at(x, 1)[0], static_cast<float>(1 + std::min(x, 4)));
}

TEST(Exr, AlphaIsDroppedAndTheDefaultLayerWins) {
  std::vector<ExrChannel> channels = rgb_channels(Imf::HALF);
  channels.push_back({"A", [](int, int) { return 0.5f; }, Imf::HALF});
  channels.push_back({"diffuse.R", blue, Imf::HALF});
  channels.push_back({"diffuse.G", blue, Imf::HALF});
  channels.push_back({"diffuse.B", blue, Imf::HALF});
  const LoadedImage loaded = decode({}, channels);
  expect_rgb(loaded.flat, 0, 0, 5, 4);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(Exr, FirstLayerIsUsedAndNamed) {
  const LoadedImage loaded = decode({}, rgb_channels(Imf::HALF, "light.key."));
  expect_rgb(loaded.flat, 0, 0, 5, 4);
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("'light.key'"), std::string::npos);
}

TEST(Exr, AbsentChannelsAndSingleOnesAreSaid) {
  const LoadedImage no_green = decode({}, {{"R", red, Imf::HALF}, {"B", blue, Imf::HALF}});
  EXPECT_EQ(no_green.flat.at(1, 1)[1], 0);
  EXPECT_EQ(no_green.flat.at(1, 1)[2], blue(1, 1));
  EXPECT_EQ(no_green.warnings.size(), 1u);
  const LoadedImage depth = decode({}, {{"Z", red, Imf::FLOAT}});
  EXPECT_EQ(depth.flat.at(1, 1)[1], red(1, 1));
  EXPECT_NE(depth.warnings.at(0).find("'Z'"), std::string::npos);
  const std::vector<ExrChannel> vectors{{"u", red, Imf::HALF}, {"v", red, Imf::HALF}};
  EXPECT_EQ(exr_refusal(exr_file(exr_header({}, vectors), vectors)),
            "test.exr: has no channels R, G, B or Y, only: u, v");
}

// ITU-R BT.2087: Rec.2020 green (0, 1, 0) is (-0.5876, 1.1329, -0.1006) in Rec.709.
TEST(Exr, OtherPrimariesAreConverted) {
  const auto zero = [](int, int) { return 0.0f; };
  const std::vector<ExrChannel> channels{
      {"R", zero, Imf::FLOAT}, {"G", [](int, int) { return 1.0f; }, Imf::FLOAT}, {"B", zero, Imf::FLOAT}};
  Imf::Header header = exr_header({}, channels);
  Imf::addChromaticities(
      header, Imf::Chromaticities({0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}));
  const LoadedImage loaded = decode(exr_file(header, channels));
  EXPECT_NEAR(loaded.flat.at(0, 0)[0], -0.5876, 1e-4);
  EXPECT_NEAR(loaded.flat.at(0, 0)[1], 1.1329, 1e-4);
  EXPECT_NEAR(loaded.flat.at(0, 0)[2], -0.1006, 1e-4);
  EXPECT_EQ(loaded.warnings.size(), 1u);
}

TEST(Exr, FirstPartOfSeveral) {
  const std::vector<ExrChannel> channels = rgb_channels(Imf::HALF);
  std::vector<Imf::Header> headers(2, exr_header({}, channels));
  for (std::size_t i = 0; i < headers.size(); ++i) {
    headers[i].setName(i == 0 ? "beauty" : "other");
    headers[i].setType(Imf::SCANLINEIMAGE);
  }
  ExrBytes stream;
  {
    Imf::MultiPartOutputFile file(stream, headers.data(), 2);
    std::vector<half> values(5 * 4, half(3.0f));
    for (int i = 0; i < 2; ++i) {
      Imf::OutputPart part(file, i);
      Imf::FrameBuffer buffer;
      for (const char* name : {"R", "G", "B"}) {
        buffer.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(values.data()), 2, 10));
      }
      part.setFrameBuffer(buffer);
      part.writePixels(4);
    }
  }
  const LoadedImage loaded = decode(stream.bytes);
  EXPECT_EQ(loaded.flat.pixels, std::vector<float>(5 * 4 * 3, 3.0f));
  ASSERT_EQ(loaded.warnings.size(), 1u);
  EXPECT_NE(loaded.warnings[0].find("2 parts"), std::string::npos);
}

TEST(Exr, DeepImagesAreRefused) {
  Imf::Header header = exr_header({.compression = Imf::NO_COMPRESSION}, rgb_channels(Imf::HALF));
  header.setType(Imf::DEEPSCANLINE);
  ExrBytes stream;
  {
    Imf::DeepScanLineOutputFile file(stream, header);
    std::vector<unsigned> counts(5 * 4);
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 20));
    std::vector<char*> pointers(5 * 4);
    for (const char* name : {"R", "G", "B"}) {
      buffer.insert(name, Imf::DeepSlice(Imf::HALF, reinterpret_cast<char*>(pointers.data()), 8, 40, 2));
    }
    file.setFrameBuffer(buffer);
    file.writePixels(4);
  }
  EXPECT_EQ(exr_refusal(stream.bytes), "test.exr: holds deep images only; flatten it first");
}

Image random_image(int channels) {
  Image image(37, 21, channels);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> stops(-10, 15);
  for (float& value : image.pixels) value = std::exp2(stops(random));
  return image;
}

TEST(ExrEncoder, FloatsComeBackExactlyAndHalvesRounded) {
  const Image image = random_image(3);
  EXPECT_EQ(decode(encode_exr(image, {.pixel_type = ExrPixelType::single_float})).flat.pixels, image.pixels);
  const Image halves = decode(encode_exr(image)).flat;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    EXPECT_NEAR(halves.pixels[i], image.pixels[i],
                image.pixels[i] * 0x1p-11);  // 11 bits of precision, all normal
  }
}

TEST(ExrEncoder, GrayAndAlpha) {
  const Image gray = random_image(1);
  const Image back = decode(encode_exr(gray, {.pixel_type = ExrPixelType::single_float})).flat;
  for (std::size_t i = 0; i < gray.pixels.size(); ++i) ASSERT_EQ(back.pixels[3 * i + 2], gray.pixels[i]);
  const Image rgba = random_image(4);
  const Image rgb = decode(encode_exr(rgba, {.pixel_type = ExrPixelType::single_float})).flat;
  for (std::size_t i = 0; i < rgba.pixels.size() / 4; ++i)
    ASSERT_EQ(rgb.pixels[3 * i + 1], rgba.pixels[4 * i + 1]);
}

TEST(ExrEncoder, HalvesSaturate) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Image image(2, 1);
  image.pixels = {1e6f, -1e6f, infinity, 65504, 65520, std::nanf("")};
  const std::vector<float> back = decode(encode_exr(image)).flat.pixels;
  EXPECT_EQ(std::vector<float>(back.begin(), back.begin() + 5),
            (std::vector<float>{65504, -65504, 65504, 65504, 65504}));
  EXPECT_TRUE(std::isnan(back[5]));
}

// 2^20 is far beyond half floats, 2^20 / 2^8 = 4096 is not; powers of two scale without rounding.
TEST(ExrEncoder, StoredScaleIsUndoneByTheReader) {
  Image image(2, 1);
  image.pixels = {0x1p20f, 256, 1, 2, 3, 5};
  for (ExrPixelType type : {ExrPixelType::half_float, ExrPixelType::single_float}) {
    const Bytes bytes = encode_exr(image, {.pixel_type = type, .stored_scale = 256});
    const LoadedImage loaded = decode(bytes);
    EXPECT_EQ(loaded.flat.pixels, image.pixels);
    EXPECT_EQ(loaded.stored_scale, 1);
    const std::string key = "welkinStoredScale";
    EXPECT_NE(std::search(bytes.begin(), bytes.end(), key.begin(), key.end()), bytes.end());
  }
}

TEST(Exr, EveryPrefixIsRefused) {
  const auto refused = [](const ExrForm& form) {
    const std::vector<ExrChannel> channels = rgb_channels(Imf::HALF);
    expect_every_prefix_refused(exr_file(exr_header(form, channels), channels), "test.exr",
                                [](std::span<const std::uint8_t> b) { decode_exr(b, "test.exr"); });
  };
  refused({});
  refused({.compression = Imf::PIZ_COMPRESSION, .tile = 2});
}

// A box2i attribute is its name, its type, the size 16 and then min.x, min.y, max.x, max.y, little-endian.
void set_window(Bytes& bytes, const std::string& attribute, int width, int height) {
  const std::string key = attribute + std::string("\0box2i\0\x10\0\0\0", 11);
  const auto found = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
  ASSERT_NE(found, bytes.end());
  const int box[4] = {0, 0, width - 1, height - 1};
  std::memcpy(&*(found + static_cast<std::ptrdiff_t>(key.size())), box, sizeof box);
}

TEST(Exr, HugeSizesInSmallFilesAreRefusedBeforeMemoryIsTaken) {
  for (int tile : {0, 16}) {
    const std::vector<ExrChannel> channels = rgb_channels(Imf::HALF);
    const Bytes small = exr_file(exr_header({.tile = tile}, channels), channels);
    Bytes bytes = small;
    set_window(bytes, "dataWindow", 100'000, 100'000);
    EXPECT_NE(exr_refusal(bytes), "(accepted)");
    bytes = small;
    set_window(bytes, "dataWindow", 40'000, 20'000);
    EXPECT_NE(exr_refusal(bytes), "(accepted)");
    bytes = small;
    set_window(bytes, "displayWindow", 100'000, 100'000);
    EXPECT_NE(exr_refusal(bytes).find("at most"), std::string::npos);
    bytes = small;
    set_window(bytes, "displayWindow", 40'000, 20'000);
    EXPECT_NE(exr_refusal(bytes), "(accepted)");
    bytes = small;
    set_window(bytes, "dataWindow", 0, 0);
    EXPECT_NE(exr_refusal(bytes), "(accepted)");
  }
}

// The library would take the gigabyte that an attribute promises. Size 4 of the first attribute of that type becomes
// 0x40000004; welkin's own walk over the header finds it, whether it knows the attribute or not.
TEST(Exr, AttributesLargerThanTheFileAreRefused) {
  const std::vector<ExrChannel> channels = rgb_channels(Imf::HALF);
  const Bytes whole = exr_file(exr_header({}, channels), channels);
  for (const std::string& name : {std::string("pixelAspectRatio"), std::string("unknown")}) {
    Bytes bytes = whole;
    const std::string key("pixelAspectRatio\0float\0\4\0\0\0", 27);
    const auto found = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
    ASSERT_NE(found, bytes.end());
    std::copy(name.begin(), name.end(), found);
    *(found + 26) = 0x40;
    EXPECT_NE(exr_refusal(bytes).find("the header is damaged"), std::string::npos) << name;
  }
}

// A preview that promises 2^30 x 2^30 pixels in 12 bytes: the library would multiply and allocate.
TEST(Exr, AttributesWithoutUseAreNotInterpreted) {
  const std::vector<ExrChannel> channels = rgb_channels(Imf::HALF);
  Imf::Header header = exr_header({}, channels);
  header.setPreviewImage(Imf::PreviewImage(1, 1));
  Bytes bytes = exr_file(header, channels);
  const std::string key("preview\0preview\0", 16);
  const auto found = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
  ASSERT_NE(found, bytes.end());
  *(found + 20 + 3) = *(found + 20 + 7) = 0x40;
  expect_rgb(decode(bytes).flat, 0, 0, 5, 4);
}

TEST(Exr, OtherFilesAreRefused) {
  EXPECT_TRUE(exr_refusal({}).starts_with("test.exr: "));
  EXPECT_TRUE(exr_refusal(Bytes(100, 'x')).starts_with("test.exr: "));
}

}  // namespace
}  // namespace welkin
