#include <welkin/image/tonemap.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <welkin/image/srgb.h>

namespace welkin {
namespace {

// IEC 61966-2-1: 0.5 encoded is 0.21404 linear; the two pieces meet at 0.04045 to within the standard's own digits.
TEST(Srgb, KnownValues) {
  EXPECT_NEAR(srgb_to_linear(0.5), 0.2140411, 1e-7);
  EXPECT_NEAR(linear_to_srgb(0.2140411), 0.5, 1e-6);
  EXPECT_DOUBLE_EQ(srgb_to_linear(1), 1);
  EXPECT_DOUBLE_EQ(srgb_to_linear(0.04), 0.04 / 12.92);
  EXPECT_NEAR(linear_to_srgb(0.0031308), linear_to_srgb(0.00313081), 1e-6);
}

TEST(ToneMap, ClampGivesTheSrgbByteOfEveryLevel) {
  Image image(256, 1, 1);
  for (int i = 0; i < 256; ++i) image.pixels[i] = static_cast<float>(srgb_to_linear(i / 255.0));
  const ByteImage bytes = tone_map(image, {.exposure_ev = 0, .curve = ToneCurve::clamp});
  for (int i = 0; i < 256; ++i) EXPECT_EQ(bytes.pixels[i], i);
}

TEST(ToneMap, ExposureIsInStops) {
  Image image(1, 1, 1);
  image.pixels = {static_cast<float>(srgb_to_linear(100 / 255.0)) / 8};
  EXPECT_EQ(tone_map(image, {.exposure_ev = 3, .curve = ToneCurve::clamp}).pixels[0], 100);
}

// Luminances 1/4 and 4 (their log-average is 1), faults and black left out: the exposure is log2 0.18.
TEST(ToneMap, AutomaticExposureBringsTheLogAverageTo18Percent) {
  Image image(6, 1, 1);
  image.pixels = {0.25f, 4, 0, -1, std::numeric_limits<float>::infinity(), std::nanf("")};
  EXPECT_NEAR(automatic_exposure_ev(image), std::log2(0.18), 1e-12);
  EXPECT_EQ(automatic_exposure_ev(Image(2, 2)), 0);
}

// L (1 + L / 16^2) / (1 + L): 16 gives 1 and 1 gives (1 + 1/256) / 2 = 0.50195, the byte 188.
TEST(ToneMap, ReinhardMapsWhiteToWhite) {
  Image image(2, 1, 1);
  image.pixels = {16, 1};
  const ByteImage bytes = tone_map(image, {.exposure_ev = 0});
  EXPECT_EQ(bytes.pixels[0], 255);
  EXPECT_EQ(bytes.pixels[1], 188);
}

// Narkowicz's curve at 0.18, by hand: 0.18 (2.51 0.18 + 0.03) / (0.18 (2.43 0.18 + 0.59) + 0.14) = 0.26690, the byte 141;
// it is 1 from 3.3 on.
TEST(ToneMap, FilmicCurve) {
  Image image(4, 1, 1);
  image.pixels = {0.18f, 10, 0, std::numeric_limits<float>::infinity()};
  EXPECT_EQ(tone_map(image, {.exposure_ev = 0, .curve = ToneCurve::filmic}).pixels,
            (std::vector<std::uint8_t>{141, 255, 0, 255}));
}

TEST(ToneMap, FaultsBecomeBlackOrWhite) {
  Image image(3, 1, 1);
  image.pixels = {std::nanf(""), -1, std::numeric_limits<float>::infinity()};
  EXPECT_EQ(tone_map(image, {.exposure_ev = 0}).pixels, (std::vector<std::uint8_t>{0, 0, 255}));
}

}  // namespace
}  // namespace welkin
