#include <welkin/sh/window.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/sh/random_coefficients.h>
#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/minimum_search.h>
#include <welkin/sh/zonal_harmonics.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

TEST(ShWindow, FactorsAreThePublishedOnes) {
  const auto hann = hann_window(4, 5), lanczos = lanczos_window(4, 5), laplacian = laplacian_window(0.01, 3);
  EXPECT_NEAR(hann[0], 1, 1e-15);
  EXPECT_NEAR(hann[1], 0.853553, 1e-6);
  EXPECT_NEAR(hann[2], 0.5, 1e-15);
  EXPECT_NEAR(hann[3], 0.146447, 1e-6);
  EXPECT_EQ(hann[4], 0);
  EXPECT_EQ(hann[5], 0);
  EXPECT_EQ(lanczos[0], 1);
  EXPECT_NEAR(lanczos[1], 0.900316, 1e-6);
  EXPECT_NEAR(lanczos[2], 2 / pi, 1e-15);
  EXPECT_EQ(lanczos[4], 0);
  EXPECT_EQ(laplacian[0], 1);
  EXPECT_NEAR(laplacian[1], 1 / 1.04, 1e-15);
  EXPECT_NEAR(laplacian[2], 1 / 1.36, 1e-15);
  EXPECT_NEAR(laplacian[3], 1 / 2.44, 1e-15);
  EXPECT_EQ(laplacian_window(INFINITY, 2), (std::vector<double>{1, 0, 0}));
}

// value(d) = 1 + a d.z becomes 1 + a/(1 + 4 lambda) d.z: the weakest lambda is (a - 1)/4.
ShCoefficients ramp(double a, int degree) {
  ShCoefficients f(degree, 1);
  f.values[0] = std::sqrt(4 * pi);
  f.values[sh_index(1, 0)] = a * std::sqrt(4 * pi / 3);
  return f;
}

TEST(ShWindow, WeakestForARampIsKnown) {
  for (int degree : {1, 2, 3, 7})
    for (double a : {1.001, 1.5, 3.0, 100.0}) {
      const double lambda = weakest_laplacian(ramp(a, degree), WindowScope::each_channel)[0];
      EXPECT_NEAR(lambda / ((a - 1) / 4), 1, 1e-9)
          << degree << " " << a;  // 1e-12 of the mean over lambda's slope
    }
  EXPECT_EQ(weakest_laplacian(ramp(0.999, 2), WindowScope::each_channel)[0], 0);
}

// Just enough is not negative; and no smaller lambda of a dense scan is enough.
TEST(ShWindow, WeakestIsTheFirstThatSuffices) {
  std::mt19937 random(1);
  for (int degree : {2, 4}) {
    for (int i = 0; i < 5; ++i) {
      ShCoefficients f = random_coefficients(degree, 1, random);
      f.values[0] = 1;
      const double lambda = weakest_laplacian(f, WindowScope::each_channel)[0];
      ASSERT_GT(lambda, 0);
      ASSERT_LT(lambda, INFINITY);
      const auto lowest = [&](double at) {
        return find_minimum(convolve(f, laplacian_window(at, degree))).value;
      };
      EXPECT_GT(lowest(lambda), -1e-11);
      for (double share : {0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 0.9999}) EXPECT_LT(lowest(share * lambda), 0);
    }
  }
}

// The irradiance of one distant light, degree 2: the smallest value is negative before and 0 after, and the light's
// side keeps 58 % of its peak of 1 (a published comparison of such fits reads a largest error of 0.42).
TEST(ShWindow, IrradianceOfOneLight) {
  std::vector<double> zonal = zonal_delta(2);
  const std::vector<double> cosine = cosine_lobe(2);
  for (int l = 0; l <= 2; ++l) zonal[l] *= cosine[l];
  const ShCoefficients f = turn_zonal(zonal, normalized({1, 2, -3}));
  EXPECT_NEAR(find_minimum(f).value, -0.04, 1e-2);
  const ShCoefficients windowed = laplacian_windowed(f, weakest_laplacian(f, WindowScope::each_channel));
  EXPECT_NEAR(find_minimum(windowed).value, 0, 1e-11);
  EXPECT_NEAR(value_in(windowed, normalized({1, 2, -3}))[0], 1 - 0.415, 2e-3);
}

TEST(ShWindow, ScopesShareTheLambda) {
  ShCoefficients rgb(1, 3);
  const double slopes[] = {0.5, 2, 3};  // weakest: 0, 0.25, 0.5
  for (int c = 0; c < 3; ++c) {
    const ShCoefficients one = ramp(slopes[c], 1);
    for (int i = 0; i < 4; ++i) rgb.values[i * 3 + c] = one.values[i];
  }
  const auto each = weakest_laplacian(rgb, WindowScope::each_channel);
  EXPECT_EQ(each[0], 0);
  EXPECT_NEAR(each[1], 0.25, 1e-9);
  EXPECT_NEAR(each[2], 0.5, 1e-9);
  const auto all = weakest_laplacian(rgb, WindowScope::all_channels);
  EXPECT_NEAR(all[0], 0.5, 1e-9);
  EXPECT_EQ(all[0], all[2]);
  const double slope = 0.2126 * 0.5 + 0.7152 * 2 + 0.0722 * 3;
  EXPECT_NEAR(weakest_laplacian(rgb, WindowScope::luminance)[1], (slope - 1) / 4, 1e-9);
}

TEST(ShWindow, LimitsAndRefusals) {
  ShCoefficients no_mean = ramp(1, 2);
  no_mean.values[0] = 0;
  EXPECT_EQ(weakest_laplacian(no_mean, WindowScope::each_channel)[0], INFINITY);
  EXPECT_EQ(weakest_laplacian(ShCoefficients(3, 1), WindowScope::each_channel)[0], 0);
  no_mean.values[0] = -1;
  EXPECT_THROW(weakest_laplacian(no_mean, WindowScope::each_channel), Error);
  EXPECT_THROW(weakest_laplacian(ShCoefficients(17, 1), WindowScope::each_channel), Error);
  EXPECT_THROW(weakest_laplacian(ShCoefficients(2, 1), WindowScope::luminance), Error);
  EXPECT_THROW(laplacian_windowed(ShCoefficients(2, 1), std::vector<double>{1, 2}), Error);
  EXPECT_THROW(laplacian_window(-1, 2), Error);
  EXPECT_THROW(hann_window(0, 2), Error);
}

}  // namespace
}  // namespace welkin
