#include <welkin/envmap/reflection/low_frequency.h>

#include <gtest/gtest.h>

#include <tests/envmap/reflection/measured_error.h>
#include <welkin/brdf/models.h>
#include <welkin/error.h>

namespace welkin {
namespace {

constexpr std::array<double, 3> white = {1, 1, 1};

TEST(LowFrequency, IsExactUnderLightOfItsDegree) {
  const Image radiance = random_smooth_map(192, 4, 3);
  for (const auto& brdf : {make_lambert_brdf({0.2, 0.5, 1}), make_ggx_brdf(0.3, {0.04, 0.5, 0.9}),
                           make_phong_brdf(30), make_ward_brdf(0.3)}) {
    const auto reflection = prepare_low_frequency(radiance, brdf);
    // Texels of 2 degrees instead of a smooth map, and the table's steps towards grazing views.
    EXPECT_LT(TrueReflection(radiance, brdf, 60, 5).relative_error(reflection), 1e-3) << brdf.name;
    EXPECT_LT(reflection.report.predicted_error, 1e-3) << brdf.name;
  }
}

TEST(LowFrequency, PredictedErrorIsTheMeasuredOne) {
  for (const unsigned seed : {1u, 2u}) {
    const Image radiance = noise_map(32, 16, seed);
    for (const auto& brdf :
         {make_lambert_brdf(white), make_phong_brdf(30), make_ggx_brdf(0.3, {0.04, 0.5, 0.9})}) {
      const auto reflection = prepare_low_frequency(radiance, brdf);
      const double measured = TrueReflection(radiance, brdf, 400, 5).relative_error(reflection);
      // Exact in the mean; 400 queries leave some 10 % of noise.
      EXPECT_GT(reflection.report.predicted_error, measured / 1.5) << brdf.name;
      EXPECT_LT(reflection.report.predicted_error, measured * 1.5) << brdf.name;
    }
  }
}

TEST(LowFrequency, LooksTheSameFromStraightAboveOnEverySide) {
  const auto reflection = prepare_low_frequency(noise_map(32, 16, 4), make_ggx_brdf(0.4, white));
  const Vec3 normal = normalized({1, 2, -2});
  const auto above = reflect(reflection, {normal, normal});
  for (const Vec3 side : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})  // 1e-7 beside it
    EXPECT_NEAR(reflect(reflection, {normal, normalized(normal + 1e-7 * side)})[0], above[0], 1e-5);
  EXPECT_EQ(reflect(reflection, {normal, -normal})[0], 0);
}

TEST(LowFrequency, RefusesWhatItCannotTake) {
  const auto brdf = make_lambert_brdf(white);
  EXPECT_THROW(prepare_low_frequency(Image(16, 8, 1), brdf), Error);
  EXPECT_THROW(prepare_low_frequency(noise_map(16, 8, 1), brdf, {.max_degree = 11}), Error);
  EXPECT_THROW(prepare_low_frequency(noise_map(16, 8, 1), brdf, {.views = 3}), Error);
  EXPECT_THROW(prepare_low_frequency(noise_map(16, 8, 1), make_ggx_brdf(0.001, white)), Error);
}

}  // namespace
}  // namespace welkin
