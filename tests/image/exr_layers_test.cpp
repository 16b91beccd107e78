#include <welkin/image/codecs/exr_layers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <random>

#include <tests/image/exr_files.h>
#include <tests/image/prefixes.h>

#include <welkin/image/codecs/exr.h>

namespace welkin {
namespace {

Image counted(int width, int height, int channels, float first) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = first + 0.37f * static_cast<float>(i);
  return image;
}

ExrLayers picture(int width, int height) {
  return {{{"", {"R", "G", "B"}, counted(width, height, 3, 1)},
           {"albedo", {"R", "G", "B"}, counted(width, height, 3, 0.001f)},
           {"depth", {"Z"}, counted(width, height, 1, 1e6f)},
           {"normal", {"X", "Y", "Z"}, counted(width, height, 3, -40)}},
          7};
}

TEST(ExrLayers, RoundTrip) {
  const ExrLayers before = picture(19, 11);
  const ExrLayers after = decode_exr_layers(encode_exr_layers(before), "p.exr");
  ASSERT_EQ(after.layers.size(), before.layers.size());
  for (std::size_t i = 0; i < before.layers.size(); ++i) {
    EXPECT_EQ(after.layers[i].name, before.layers[i].name);
    EXPECT_EQ(after.layers[i].channels, before.layers[i].channels);
    EXPECT_EQ(after.layers[i].image.width, 19);
    EXPECT_EQ(after.layers[i].image.height, 11);
    EXPECT_EQ(after.layers[i].image.pixels, before.layers[i].image.pixels);
  }
  EXPECT_EQ(after.error_degrees_of_freedom, 7);
}

TEST(ExrLayers, ValuesThatAreNoNumbersStay) {
  ExrLayers layers{{{"", {"Y"}, Image(2, 1, 1)}}, {}};
  layers.layers[0].image.pixels = {std::numeric_limits<float>::infinity(), -1e-40f};
  EXPECT_EQ(decode_exr_layers(encode_exr_layers(layers), "p.exr").layers[0].image.pixels,
            layers.layers[0].image.pixels);
}

TEST(ExrLayers, PlainReaderGetsTheDefaultLayer) {
  const ExrLayers layers = picture(9, 5);
  const LoadedImage loaded = decode_exr(encode_exr_layers(layers), "p.exr");
  EXPECT_EQ(loaded.flat.pixels, layers.layers[0].image.pixels);
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(ExrLayers, ReadsFilesWithoutLayersAndFindsThem) {
  const ExrLayers read =
      decode_exr_layers(encode_exr(counted(6, 4, 4, 1), {ExrPixelType::single_float, 1}), "p.exr");
  ASSERT_EQ(read.layers.size(), 1u);
  EXPECT_EQ(read.layers[0].channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  EXPECT_EQ(read.layers[0].image.pixels, counted(6, 4, 4, 1).pixels);
  EXPECT_FALSE(read.error_degrees_of_freedom);
  constexpr std::array<std::string_view, 3> rgb{"R", "G", "B"};
  EXPECT_EQ(find_layer(read, "", rgb), nullptr);
  EXPECT_EQ(find_layer(picture(2, 2), "beauty", rgb), nullptr);
  const ExrLayers layers = picture(2, 2);
  EXPECT_EQ(find_layer(layers, "albedo", rgb), &layers.layers[1]);
}

TEST(ExrLayers, TruncatedAnywhere) {
  expect_every_prefix_refused(encode_exr_layers(picture(7, 3)), "p.exr",
                              [](std::span<const std::uint8_t> bytes) { decode_exr_layers(bytes, "p.exr"); });
}

// Whatever one byte says instead: read, or refused in one line; never anything else.
TEST(ExrLayers, DamagedAnywhere) {
  const auto whole = encode_exr_layers(picture(7, 3));
  std::mt19937 random(3);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto bytes = whole;
    bytes[at] = static_cast<std::uint8_t>(random());
    const std::string message =
        refusal(bytes, [](std::span<const std::uint8_t> b) { decode_exr_layers(b, "p.exr"); });
    EXPECT_TRUE(message == "(accepted)" || message.starts_with("p.exr: ")) << at << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << at << message;
  }
}

// A box2i attribute is its name, its type, the size 16 and then min.x, min.y, max.x, max.y. The library would take memory
// for 16 lines of any width as soon as it opens the part.
TEST(ExrLayers, HugeSizesAreRefusedBeforeMemoryIsTaken) {
  auto bytes = encode_exr_layers(picture(8, 4));
  const std::string key = std::string("dataWindow\0box2i\0\x10\0\0\0", 21);
  const auto at = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
  ASSERT_NE(at, bytes.end());
  const int box[4] = {0, 0, 499'999'999, 3};
  std::memcpy(&*(at + static_cast<std::ptrdiff_t>(key.size())), box, sizeof box);
  const std::string message =
      refusal(bytes, [](std::span<const std::uint8_t> b) { decode_exr_layers(b, "p.exr"); });
  EXPECT_NE(message.find("the header gives a size of 500000000 x 4"), std::string::npos) << message;
}

TEST(ExrLayers, SubsampledChannelsAreRefused) {
  const std::string message =
      refusal(encode_exr_layers(picture(8, 4)), [](std::span<const std::uint8_t> bytes) {
        std::vector<std::uint8_t> changed(bytes.begin(), bytes.end());
        const std::string name = "depth.Z";
        const auto at = std::search(changed.begin(), changed.end(), name.begin(), name.end());
        *(at + static_cast<std::ptrdiff_t>(name.size()) + 1 + 8) =
            2;  // after the type and four flags: xSampling
        decode_exr_layers(changed, "p.exr");
      });
  EXPECT_EQ(message, "p.exr: has the subsampled channel depth.Z");
}

}  // namespace
}  // namespace welkin
