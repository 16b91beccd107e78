#include <welkin/image/compare.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <welkin/image/srgb.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Differences 0, 3, -4, 0: mean square 25/4. B: 4, 4, 4, 4.
TEST(Compare, FiguresByHand) {
  const std::vector<float> a{4, 7, 0, 4}, b{4, 4, 4, 4};
  const ImageDifference d = compare_images(a, b, 2);
  EXPECT_DOUBLE_EQ(d.rmse, 2.5);
  EXPECT_DOUBLE_EQ(d.relative_rmse, 2.5 / 4);
  EXPECT_DOUBLE_EQ(d.psnr_db, 20 * std::log10(4 / 2.5));
  EXPECT_EQ(d.max_abs, 4);
  EXPECT_EQ(d.max_pixel, 1u);
  EXPECT_EQ(d.max_channel, 0);
  EXPECT_EQ(d.max_a, 0);
  EXPECT_EQ(d.max_b, 4);
}

// Weight 3 on the pixel with differences (0, 3), 1 on the one with (4, 0): (3 * 9 + 16) / 8.
TEST(Compare, WeightsAreOfPixels) {
  const std::vector<float> a{4, 7, 0, 4}, b{4, 4, 4, 4}, weights{3, 1};
  EXPECT_DOUBLE_EQ(compare_images(a, b, 2, weights).rmse, std::sqrt(43.0 / 8));
}

TEST(Compare, EqualAndBlackImages) {
  const std::vector<float> black(3), white(3, 1.0f);
  EXPECT_EQ(compare_images(white, white, 3).psnr_db, infinity);
  EXPECT_EQ(compare_images(white, white, 3).relative_rmse, 0);
  EXPECT_EQ(compare_images(white, black, 3).relative_rmse, infinity);
  EXPECT_EQ(compare_images(white, black, 3).psnr_db, -infinity);
  EXPECT_EQ(compare_images(black, black, 3).rmse, 0);
}

TEST(Compare, FaultsAreLeftOutAndCountedWhereTheyDiffer) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<float> a{1, nan, nan, inf, inf, 3}, b{1, nan, 1, inf, -inf, 1};
  const ImageDifference d = compare_images(a, b, 1);
  EXPECT_EQ(d.unequal_faults, 2u);
  EXPECT_DOUBLE_EQ(d.rmse, std::sqrt(4.0 / 2));
}

// The largest difference lies in the last of several chunks, and sums keep their order.
TEST(Compare, SameFiguresOnAnyNumberOfThreads) {
  std::vector<float> a(150'000), b(150'000);
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = b[i] = 1 / static_cast<float>(i + 1);
  for (std::size_t i = 0; i < a.size(); i += 7) a[i] *= 1.1f;
  a[149'000] = 5;
  set_thread_count(1);
  const ImageDifference expected = compare_images(a, b, 3);
  EXPECT_EQ(expected.max_pixel, 149'000u / 3);
  EXPECT_EQ(expected.max_channel, 149'000 % 3);
  for (int threads : {2, 8}) {
    set_thread_count(threads);
    EXPECT_EQ(compare_images(a, b, 3).rmse, expected.rmse);
    EXPECT_EQ(compare_images(a, b, 3).relative_rmse, expected.relative_rmse);
  }
  set_thread_count(0);
}

double lightness(const std::uint8_t* rgb) {
  const double y = 0.2126 * srgb_to_linear(rgb[0] / 255.0) + 0.7152 * srgb_to_linear(rgb[1] / 255.0) +
                   0.0722 * srgb_to_linear(rgb[2] / 255.0);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

// Relative differences 10^-7 to 10^3 of a reference whose root mean square is 1: lightness is linear in the decades
// between 10^-6 and 10^2. Bytes and the 256 colours quantize by 0.4 each in lightness.
TEST(DifferenceImage, LightnessIsLinearInDecades) {
  const int count = 11;
  Image a(count, 1, 1), b(count, 1, 1);
  for (int x = 0; x < count; ++x) {
    b.pixels[x] = 1;
    a.pixels[x] = 1 + static_cast<float>(std::pow(10.0, x - 7));
  }
  const ByteImage picture = difference_image(a, b);
  for (int x = 0; x < count; ++x) {
    const double relative = double{a.pixels[x]} - 1;  // as rounded to float
    const double expected = 100 * std::clamp(std::log10(relative / 1e-6) / 8, 0.0, 1.0);
    EXPECT_NEAR(lightness(picture.at(x, 0)), expected, 0.8) << x;
  }
}

TEST(DifferenceImage, EqualIsBlackAndAnUnequalFaultGreen) {
  Image a(2, 1), b(2, 1);
  a.pixels = {1, 2, 3, 1, 1, std::numeric_limits<float>::quiet_NaN()};
  b.pixels = {1, 2, 3, 1, 1, 1};
  EXPECT_EQ(difference_image(a, b).pixels, (std::vector<std::uint8_t>{0, 0, 0, 0, 255, 0}));
}

}  // namespace
}  // namespace welkin
