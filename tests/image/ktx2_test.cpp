#include <welkin/image/codecs/ktx2.h>

#include <limits>
#include <span>
#include <tuple>

#include <gtest/gtest.h>

#include <welkin/error.h>
#include <welkin/image/half.h>
#include <welkin/parallel/parallel_for.h>

#include "tests/image/textures.h"

namespace welkin {
namespace {

constexpr PixelFormat all_formats[] = {PixelFormat::rgba16f, PixelFormat::rgba32f, PixelFormat::rgb9e5,
                                       PixelFormat::rg16f,   PixelFormat::rg32f,   PixelFormat::r11g11b10f};

void expect_within_rounding(std::span<const float> before, std::span<const float> after, PixelFormat format,
                            double scale) {
  ASSERT_EQ(before.size(), after.size());
  const std::size_t stored =
      std::min<std::size_t>(3, static_cast<std::size_t>(pixel_layout(format).channels));
  for (std::size_t i = 0; i < before.size(); i += 3) {
    const double largest = std::max({before[i], before[i + 1], before[i + 2]}) / scale;
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = c < stored ? static_cast<double>(before[i + c]) : 0.0;
      ASSERT_NEAR(after[i + c], expected, scale * rounding(format, before[i + c] / scale, largest))
          << i << " " << c;
    }
  }
}

TEST(Ktx2, CubesComeBackWithinRounding) {
  for (const PixelFormat format : all_formats) {
    for (const int zstd_level : {0, 3}) {
      for (const auto& [size, full] : {std::tuple{1, false}, {2, true}, {6, true}, {7, false}, {32, true}}) {
        const CubeMips cube = test_cube(size, full);
        Ktx2Options options;
        options.format = format;
        options.zstd_level = zstd_level;
        const EncodedTexture texture = encode_ktx2(cube, options);
        EXPECT_EQ(texture.clipped, 0u);
        EXPECT_EQ(texture.stored_scale, 1);
        const LoadedImage back = decode_ktx2(texture.bytes, "memory");
        ASSERT_TRUE(back.is_cube());
        EXPECT_TRUE(back.warnings.empty());
        ASSERT_EQ(back.cube.levels.size(), cube.levels.size());
        for (std::size_t k = 0; k < cube.levels.size(); ++k) {
          ASSERT_EQ(back.cube.levels[k].size, cube.levels[k].size);
          expect_within_rounding(cube.levels[k].texels, back.cube.levels[k].texels, format, 1);
        }
      }
    }
  }
}

TEST(Ktx2, FlatImagesComeBackWithinRounding) {
  for (const PixelFormat format : all_formats) {
    const Image image = test_image(13, 5);
    Ktx2Options options;
    options.format = format;
    options.zstd_level = 1;
    const LoadedImage back = decode_ktx2(encode_ktx2(image, options).bytes, "memory");
    ASSERT_FALSE(back.is_cube());
    ASSERT_EQ(back.flat.width, 13);
    ASSERT_EQ(back.flat.height, 5);
    expect_within_rounding(image.pixels, back.flat.pixels, format, 1);
  }
}

TEST(Ktx2, ASunIsScaledAndComesBack) {
  CubeMips cube = test_cube(8, true);
  cube.levels[0].texels[100] = 200000;
  for (const PixelFormat format : {PixelFormat::rgba16f, PixelFormat::rgb9e5}) {
    Ktx2Options options;
    options.format = format;
    const EncodedTexture texture = encode_ktx2(cube, options);
    EXPECT_EQ(texture.stored_scale, 4);  // 200000 / 65408 = 3.06
    EXPECT_EQ(texture.clipped, 0u);
    EXPECT_EQ(read_ktx2_keys(texture.bytes, "memory").at("WelkinStoredScale"), "4");
    const LoadedImage back = decode_ktx2(texture.bytes, "memory");
    EXPECT_EQ(back.stored_scale, 1);  // the pixels are true values
    expect_within_rounding(cube.levels[0].texels, back.cube.levels[0].texels, format, 4);
  }
}

TEST(Ktx2, ClippingIsCounted) {
  CubeMips cube = test_cube(4, false);
  cube.levels[0].texels[10] = 1e6f;
  cube.levels[0].texels[11] = std::numeric_limits<float>::infinity();
  cube.levels[0].texels[12] = std::nanf("");
  Ktx2Options options;
  options.range = RangePolicy::clip;
  const EncodedTexture texture = encode_ktx2(cube, options);
  EXPECT_EQ(texture.stored_scale, 1);
  EXPECT_EQ(texture.clipped, 3u);
  const LoadedImage back = decode_ktx2(texture.bytes, "memory");
  EXPECT_EQ(back.cube.levels[0].texels[10], half_max);
  EXPECT_EQ(back.cube.levels[0].texels[11], half_max);
  EXPECT_EQ(back.cube.levels[0].texels[12], 0.0f);
}

TEST(Ktx2, AWantedScaleIsUsed) {
  Ktx2Options options;
  options.stored_scale = 0.25;
  const Image image = test_image(3, 3);
  const EncodedTexture texture = encode_ktx2(image, options);
  EXPECT_EQ(texture.stored_scale, 0.25);
  EXPECT_EQ(read_ktx2_keys(texture.bytes, "memory").at("WelkinStoredScale"), "0.25");
  expect_within_rounding(image.pixels, decode_ktx2(texture.bytes, "memory").flat.pixels, options.format,
                         0.25);
  for (const double wrong : {3.0, -2.0, 0x1p200, std::numeric_limits<double>::infinity()}) {
    options.stored_scale = wrong;
    EXPECT_THROW(encode_ktx2(image, options), Error) << wrong;
  }
}

TEST(Ktx2, KeysComeBack) {
  Ktx2Options options;
  options.keys = {{"WelkinQuantity", "prefiltered radiance"}, {"A", ""}, {"author", "J. Ångström"}};
  const auto keys = read_ktx2_keys(encode_ktx2(test_image(1, 1), options).bytes, "memory");
  const std::map<std::string, std::string> expected = {{"A", ""},
                                                       {"KTXorientation", "rd"},
                                                       {"KTXwriter", "welkin 0.1"},
                                                       {"WelkinQuantity", "prefiltered radiance"},
                                                       {"author", "J. Ångström"}};
  EXPECT_EQ(keys, expected);
}

TEST(Ktx2, BadOptionsAreRefused) {
  const Image image = test_image(2, 2);
  const std::string zero(1, '\0');
  for (const auto& [key, value] : std::map<std::string, std::string>{{"", "x"},
                                                                     {"KTXorientation", "ru"},
                                                                     {"ktxmine", "x"},
                                                                     {"WelkinStoredScale", "2"},
                                                                     {"a" + zero, "x"},
                                                                     {"b", zero}}) {
    Ktx2Options options;
    options.keys = {{key, value}};
    EXPECT_THROW(encode_ktx2(image, options), Error) << key;
  }
  Ktx2Options options;
  options.zstd_level = 23;
  EXPECT_THROW(encode_ktx2(image, options), Error);
  EXPECT_THROW(encode_ktx2(Image{}, {}), Error);
  EXPECT_THROW(encode_ktx2(CubeMips{}, {}), Error);
  CubeMips wrong;
  wrong.levels = {Cube(4), Cube(3)};
  EXPECT_THROW(encode_ktx2(wrong, {}), Error);
  wrong.levels = {Cube(1), Cube(1)};
  EXPECT_THROW(encode_ktx2(wrong, {}), Error);
}

TEST(Ktx2, SameBytesOnAnyNumberOfThreads) {
  const CubeMips cube = test_cube(128, true);
  Ktx2Options options;
  options.zstd_level = 1;
  set_thread_count(1);
  const EncodedTexture one = encode_ktx2(cube, options);
  set_thread_count(8);
  const EncodedTexture eight = encode_ktx2(cube, options);
  set_thread_count(0);
  EXPECT_EQ(one.bytes, eight.bytes);
}

}  // namespace
}  // namespace welkin
