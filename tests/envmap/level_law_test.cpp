#include <welkin/envmap/level_law.h>

#include <gtest/gtest.h>

#include <welkin/error.h>

namespace welkin {
namespace {

TEST(LevelLaw, HasThePublishedFormulas) {
  EXPECT_DOUBLE_EQ(level_to_perceptual_roughness(LevelLaw::linear, 2, 9, 256), 0.25);
  EXPECT_DOUBLE_EQ(perceptual_roughness_to_level(LevelLaw::quadratic, 0.5, 5, 256), 3);    // 4 * 0.5 * 1.5
  EXPECT_DOUBLE_EQ(perceptual_roughness_to_level(LevelLaw::logarithmic, 0.5, 9, 256), 6);  // log2(256 * 0.25)
}

TEST(LevelLaw, InvertsItself) {
  for (LevelLaw law : {LevelLaw::linear, LevelLaw::quadratic, LevelLaw::logarithmic})
    for (double level : {0.5, 1.0, 2.0, 3.7, 6.0}) {
      const double r = level_to_perceptual_roughness(law, level, 7, 64);
      EXPECT_NEAR(perceptual_roughness_to_level(law, r, 7, 64), level, 1e-12) << name(law);
    }
}

TEST(LevelLaw, NamesReadBack) {
  for (LevelLaw law : {LevelLaw::linear, LevelLaw::quadratic, LevelLaw::logarithmic})
    EXPECT_EQ(parse_level_law(name(law)), law);
  EXPECT_THROW(parse_level_law("cubic"), Error);
}

// The families have the same spread for narrow lobes: K(0) of a lobe with that second moment differs in shape only.
TEST(KernelForAlpha, PhongAndGaussianAgreeWhenNarrow) {
  const double phong = evaluate(kernel_for_alpha(KernelKind::phong, 0.05), 0.0);
  const double gaussian = evaluate(kernel_for_alpha(KernelKind::gaussian, 0.05), 0.0);
  EXPECT_NEAR(phong / gaussian, 1, 0.01);
  EXPECT_NEAR(evaluate(kernel_for_alpha(KernelKind::phong, 1), 0.4), evaluate(make_lambert_kernel(), 0.4),
              1e-12);
}

}  // namespace
}  // namespace welkin
