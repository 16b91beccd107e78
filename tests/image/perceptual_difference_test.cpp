#include <welkin/image/perceptual_difference.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <welkin/image/srgb.h>

namespace welkin {
namespace {

Image constant(float r, float g, float b, int size = 48) {
  Image image(size, size);
  for (std::size_t i = 0; i < image.pixels.size(); i += 3)
    image.pixels[i] = r, image.pixels[i + 1] = g, image.pixels[i + 2] = b;
  return image;
}

Image scene(int size = 96) {
  Image image(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const float inside =
          std::hypot(static_cast<float>(x - 48), static_cast<float>(y - 48)) < 25 ? 0.5f : 0.1f;
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = inside * (1 + 0.3f * static_cast<float>(c));
    }
  return image;
}

Image with_noise(Image image, double sigma) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (float& value : image.pixels)
    value = static_cast<float>(
        srgb_to_linear(std::clamp(linear_to_srgb(double{value}) + sigma * normal(random), 0.0, 1.0)));
  return image;
}

TEST(PerceptualDifference, IdenticalIsZero) {
  const PerceptualDifference difference = perceptual_difference(scene(), scene());
  EXPECT_EQ(difference.largest, 0);
  EXPECT_EQ(difference.mean, 0);
}

// HyAB of black and white is L* = 100: 100^0.7 over the largest distance, blue and green, is beyond the knee.
TEST(PerceptualDifference, BlackAndWhiteIsNearlyOne) {
  const PerceptualDifference difference = perceptual_difference(constant(0, 0, 0), constant(1, 1, 1));
  EXPECT_GT(difference.mean, 0.96);
  EXPECT_LE(difference.largest, 1);
  EXPECT_NEAR(difference.largest, difference.median, 1e-6);
  EXPECT_NEAR(perceptual_difference(constant(0, 1, 0), constant(0, 0, 1)).mean, 1, 1e-5);
}

// Lightness alone, constant pictures: filters do nothing, no features. L* of 0.18 and 0.20 is 49.50 and 51.84, so the
// error is 2.34^0.7 0.95 / 0.4 over the distance of green and blue to that power.
TEST(PerceptualDifference, GraysByHand) {
  const auto lightness = [](double y) { return 116 * std::cbrt(y) - 16; };
  const double distance = lightness(0.2) - lightness(0.18);
  // L*, a*, b* of the primaries (CIE 1976): green 87.735, -86.183, 83.180; blue 32.297, 79.187, -107.857.
  const double most = 87.735 - 32.297 +
                      std::hypot(0.87735 * -86.183 - 0.32297 * 79.187, 0.87735 * 83.180 + 0.32297 * 107.857);
  const double expected = std::pow(distance / most, 0.7) * 0.95 / 0.4;
  EXPECT_NEAR(perceptual_difference(constant(0.18f, 0.18f, 0.18f), constant(0.2f, 0.2f, 0.2f)).mean, expected,
              2e-3 * expected);
}

TEST(PerceptualDifference, SymmetricAndBounded) {
  const Image a = scene(), b = with_noise(scene(), 0.2);
  const PerceptualDifference one = perceptual_difference(a, b), other = perceptual_difference(b, a);
  for (std::size_t i = 0; i < one.map.pixels.size(); ++i) {
    EXPECT_NEAR(one.map.pixels[i], other.map.pixels[i], 1e-6);
    EXPECT_GE(one.map.pixels[i], 0);
    EXPECT_LE(one.map.pixels[i], 1);
  }
}

TEST(PerceptualDifference, GrowsWithNoise) {
  double before = 0;
  for (const double sigma : {0.005, 0.02, 0.05, 0.1, 0.2}) {
    const double mean = perceptual_difference(scene(), with_noise(scene(), sigma)).mean;
    EXPECT_GT(mean, 1.2 * before) << sigma;
    before = mean;
  }
}

// Fine noise is invisible from afar.
TEST(PerceptualDifference, FallsWithDistance) {
  double before = 1;
  for (const double pixels_per_degree : {10.0, 30.0, 67.0, 150.0}) {
    const double mean = perceptual_difference(scene(), with_noise(scene(), 0.1), {pixels_per_degree}).mean;
    EXPECT_LT(mean, before) << pixels_per_degree;
    before = mean;
  }
}

TEST(PerceptualDifference, IsWhereTheDifferenceIs) {
  const Image a = scene();
  Image b = a;
  for (int y = 70; y < 80; ++y)
    for (int x = 70; x < 80; ++x) b.at(x, y)[0] = 0.8f;
  const PerceptualDifference difference = perceptual_difference(a, b);
  EXPECT_GT(difference.map.at(75, 75)[0], 0.3f);
  EXPECT_EQ(difference.map.at(10, 10)[0], 0);
  EXPECT_EQ(difference.median, 0);
}

TEST(PerceptualDifference, TinyPicturesWork) {
  EXPECT_GT(perceptual_difference(constant(0, 0, 0, 1), constant(1, 1, 1, 1)).mean, 0.96);
}

TEST(PerceptualDifference, MapColoursRiseInLightness) {
  Image map(11, 1, 1);
  for (int i = 0; i <= 10; ++i) map.pixels[static_cast<std::size_t>(i)] = 0.1f * static_cast<float>(i);
  const ByteImage image = perceptual_map_image(map);
  double before = -1;
  for (int i = 0; i <= 10; ++i) {
    const auto* p = image.at(i, 0);
    const double luminance = 0.2126 * srgb_to_linear(p[0] / 255.0) + 0.7152 * srgb_to_linear(p[1] / 255.0) +
                             0.0722 * srgb_to_linear(p[2] / 255.0);
    EXPECT_GT(luminance, before) << i;
    before = luminance;
  }
}

}  // namespace
}  // namespace welkin
