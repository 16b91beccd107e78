#include <welkin/envmap/ibl.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "maps.h"

#include <welkin/envmap/verify.h>
#include <welkin/error.h>

namespace welkin {
namespace {

IblOptions small_options() {
  IblOptions options;
  options.size = 64;
  options.irradiance_size = 16;
  options.dfg_size = 16;
  return options;
}

TEST(Ibl, OfAConstantIsConstant) {
  const IblSet set = make_ibl(constant_map(128, 64, 2), small_options());
  for (const Cube& level : set.specular.levels)
    for (float v : level.texels) ASSERT_NEAR(v, 2, 2e-6);
  for (float v : set.irradiance.texels) ASSERT_NEAR(v, 2 * std::numbers::pi, 2e-6 * std::numbers::pi);
  EXPECT_NEAR(set.radiance_sh.values[0], 2 * std::sqrt(4 * std::numbers::pi), 1e-9);
}

TEST(Ibl, VerificationPassesOnASunMap) {
  IblOptions options = small_options();
  options.levels = 7;
  const Image map = sun_map(256, 128, 5e4f);
  const IblSet set = make_ibl(map, options);
  const IblErrors errors = verify_ibl(set, map, options, {.directions = 24});
  ASSERT_EQ(errors.levels.size(), 7u);
  for (std::size_t k = 1; k < errors.levels.size(); ++k) {
    EXPECT_LT(errors.levels[k].relative_rms, 1e-4) << k;
    EXPECT_LT(errors.levels[k].max_over_mean, 1e-3) << k;
    EXPECT_LT(errors.levels[k].edge_step, 1.2)
        << k;  // the sun's lobe is two texels wide: coarse to predict from
  }
  EXPECT_LT(std::abs(errors.levels[0].energy), 1e-4);
  EXPECT_LT(errors.irradiance.relative_rms, 1e-4);
  EXPECT_LT(errors.dfg_max, 1e-4);
  EXPECT_GT(errors.sh_max, 0.005);  // nine coefficients cannot follow a sun
  EXPECT_LT(errors.sh_max, 0.12);   // nor be worse than for one distant light
}

// A verification that cannot see an error is none: a level that is one per cent too bright must show.
TEST(Ibl, VerificationSeesAMistake) {
  IblOptions options = small_options();
  options.levels = 4;
  const Image map = noise_map(128, 64, 3);
  IblSet set = make_ibl(map, options);
  for (float& v : set.specular.levels[2].texels) v *= 1.01f;
  const IblErrors errors = verify_ibl(set, map, options, {.directions = 16});
  EXPECT_NEAR(errors.levels[2].relative_rms, 0.01, 1e-3);
  EXPECT_LT(errors.levels[1].relative_rms, 1e-4);
}

TEST(Ibl, TheThreeWaysToIrradianceAgreeWithinTheirErrors) {
  const Image map = sun_map(64, 32, 200);
  IblOptions options = small_options();
  options.irradiance_size = 6;
  const Cube exact = make_ibl(map, options).irradiance;
  options.diffuse = DiffuseMethod::brute_force;
  const Cube brute = make_ibl(map, options).irradiance;
  options.diffuse = DiffuseMethod::sh;
  const Cube sh = make_ibl(map, options).irradiance;
  double largest = 0, worst_brute = 0, worst_sh = 0;
  for (std::size_t i = 0; i < exact.texels.size(); ++i) {
    largest = std::max(largest, static_cast<double>(brute.texels[i]));
    worst_brute = std::max(
        worst_brute, std::abs(static_cast<double>(exact.texels[i]) - static_cast<double>(brute.texels[i])));
    worst_sh = std::max(worst_sh,
                        std::abs(static_cast<double>(sh.texels[i]) - static_cast<double>(brute.texels[i])));
  }
  EXPECT_LT(worst_brute, 1e-3 * largest);
  EXPECT_LT(worst_sh, 0.1 * largest);  // 9.4 % for one distant light, the worst case
  EXPECT_GT(worst_sh, 10 * worst_brute);
}

TEST(Ibl, RefusesOptionsOutOfRange) {
  const Image map = noise_map(16, 8, 1);
  IblOptions options = small_options();
  options.levels = 8;  // 64 has 7
  EXPECT_THROW(make_ibl(map, options), Error);
  options = small_options();
  options.size = 0;
  EXPECT_THROW(make_ibl(map, options), Error);
}

}  // namespace
}  // namespace welkin
