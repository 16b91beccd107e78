#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <tests/envmap/maps.h>
#include <welkin/brdf/models.h>
#include <welkin/envmap/reflection/simplex_search.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/envmap/reflection/tap_fit.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr std::array<double, 3> f0 = {0.04, 0.5, 1};

const StretchedTapsTable& default_table() {
  static const StretchedTapsTable table = make_stretched_taps_table({64, 5, LevelLaw::linear});
  return table;
}

// Patches of noise 8 x 4, and a lamp of 60 times the mean: gray, so that channels can be values of F0.
Image patchy_map(unsigned seed) {
  const Image noise = noise_map(8, 4, seed);
  Image map(64, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) std::fill_n(map.at(x, y), 3, noise.at(x / 8, y / 8)[0]);
  std::fill_n(map.at(20, 9), 6, 60.0f);
  return map;
}

// Mean |error| over mean truth, a channel.
template <class Surface>
std::array<double, 3> mean_error(const Surface& surface, const std::vector<ReflectionQuery>& queries,
                                 const std::vector<double>& truth) {
  std::array<double, 3> error{}, total{};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const std::array<double, 3> rgb = reflect(surface, queries[i]);
    for (int c = 0; c < 3; ++c) {
      error[c] += std::abs(rgb[c] - truth[3 * i + c]);
      total[c] += truth[3 * i + c];
    }
  }
  for (int c = 0; c < 3; ++c) error[c] /= total[c];
  return error;
}

TEST(SimplexSearch, FindsTheValleyOfRosenbrock) {
  const auto function = [](std::span<const double> x) {
    return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
  };
  const std::array start = {-1.2, 1.0}, step = {0.3, 0.3};
  const SimplexMinimum found = simplex_search(function, start, step, 200);
  EXPECT_NEAR(found.point[0], 1, 1e-6);  // 200 steps reach rounding of the value, its root in the point
  EXPECT_NEAR(found.point[1], 1, 1e-6);
  EXPECT_LE(found.value, 1e-12);
}

TEST(SplitSum, OfAConstantEnvironmentIsTheDfg) {
  const Image map = constant_map(32, 16, 2);
  const SplitSum plain = prepare_split_sum(map, f0, 0.2, {32, 0, LevelLaw::linear, {}});
  const StretchedTaps taps{plain.chain, default_table(), f0, 0.2};
  for (double cos_view : {1e-6, 0.01, 0.3, 0.8, 1.0}) {
    const ReflectionQuery query{{0, 1, 0}, {std::sqrt(1 - cos_view * cos_view), cos_view, 0}};
    const DfgValue dfg = integrate_dfg(cos_view, 0.2);
    for (const auto& rgb : {reflect(plain, query), reflect(taps, query)})
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(rgb[c], 2 * (f0[c] * dfg.scale + dfg.bias), 3e-6);  // float texels of 2, filter 1e-6
  }
}

TEST(SplitSum, NothingIsSeenFromBelow) {
  const SplitSum plain = prepare_split_sum(constant_map(16, 8, 1), f0, 0.2, {16, 2, LevelLaw::linear, {}});
  const StretchedTaps taps{plain.chain, default_table(), f0, 0.2};
  const ReflectionQuery below{{0, 1, 0}, normalized(Vec3{1, -0.1, 0})};
  EXPECT_EQ(reflect(plain, below), (std::array<double, 3>{}));
  EXPECT_EQ(reflect(taps, below), (std::array<double, 3>{}));
}

TEST(StretchedTaps, HaveAThirdOfTheErrorOfTheSplitSum) {
  const auto queries = random_reflection_queries(60, 5, 0.0);
  std::array<double, 3> plain_sum{}, taps_sum{};
  for (double r : {0.35, 0.6}) {
    const Image map = patchy_map(static_cast<unsigned>(100 * r));
    const auto truth = reflect_brute_force(map, make_ggx_brdf(r * r, f0), queries);
    const SplitSum plain = prepare_split_sum(map, f0, r * r, {64, 5, LevelLaw::linear, {}});
    const std::array<double, 3> plain_error = mean_error(plain, queries, truth);
    const std::array<double, 3> taps_error =
        mean_error(StretchedTaps{plain.chain, default_table(), f0, r * r}, queries, truth);
    for (int c = 0; c < 3; ++c) {
      plain_sum[c] += plain_error[c] / 2;
      taps_sum[c] += taps_error[c] / 2;
    }
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(plain_sum[c], 0.1);  // it is bad: 0.16 to 0.5, over all view angles
    EXPECT_LT(taps_sum[c], plain_sum[c] / 3);
  }
}

TEST(StretchedTaps, AreOneSmoothSheet) {
  const StretchedTapsTable& table = default_table();
  ASSERT_EQ(table.texels.size(), std::size_t{24} * 24 * 3);
  for (int j = 0; j < 24; ++j)
    for (int i = 0; i < 24; ++i) {
      const double cos_view = std::pow((i + 0.5) / 24, 2), r = (j + 0.5) / 24;
      const DfgValue dfg = integrate_dfg(cos_view, r * r);
      DfgValue sum;
      const StretchedTap* taps = &table.texels[(std::size_t{24} * j + i) * 3];
      for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(std::isfinite(taps[k].offset) && std::isfinite(taps[k].scale));
        ASSERT_GE(taps[k].perceptual_roughness, 0.4 * r - 1e-12);
        ASSERT_LE(taps[k].perceptual_roughness, 1);
        // Negative weights are penalised, not forbidden: -0.34 where no level is as narrow as the lobe.
        ASSERT_GE(taps[k].scale, -0.6);
        sum.scale += taps[k].scale;
        sum.bias += taps[k].bias;
      }
      ASSERT_NEAR(sum.scale, dfg.scale, 1e-9);  // elimination in double
      ASSERT_NEAR(sum.bias, dfg.bias, 1e-9);
      if (i == 0) continue;
      // From texel to texel a tap turns (by about atan of its offset) and widens less than the roughness, of the lobe or
      // of the chain's first level.
      const double width = std::max(r, 0.25);
      for (int k = 0; k < 3; ++k) {
        EXPECT_LT(std::abs(std::atan(taps[k].offset) - std::atan(taps[k - 3].offset)), width)
            << i << " " << j << " " << k;
        EXPECT_LT(std::abs(taps[k].perceptual_roughness - taps[k - 3].perceptual_roughness), 0.8 * width);
      }
    }
}

TEST(StretchedTaps, AtTheEndsOfTheTableAreFinite) {
  for (double cos_view : {0.0, 1e-9, 1.0})
    for (double r : {0.0, 1.0})
      for (const StretchedTap& tap : look_up_stretched_taps(default_table(), cos_view, r)) {
        EXPECT_TRUE(std::isfinite(tap.offset + tap.scale + tap.bias));
        EXPECT_GE(tap.perceptual_roughness, 0);
      }
}

TEST(StretchedTaps, TableIsTheSameOnAnyNumberOfThreads) {
  const StretchedTapsOptions small{2, 6, 6, 2};
  const ChainShape chain{16, 3, LevelLaw::quadratic};
  set_thread_count(1);
  const Image one = stretched_taps_image(make_stretched_taps_table(chain, small));
  set_thread_count(0);
  EXPECT_EQ(one.pixels, stretched_taps_image(make_stretched_taps_table(chain, small)).pixels);
}

TEST(StretchedTaps, BadOptionsAreRefused) {
  const ChainShape chain;
  EXPECT_THROW(make_stretched_taps_table(chain, {0, 24, 24, 2}), Error);
  EXPECT_THROW(make_stretched_taps_table(chain, {3, 3, 24, 2}), Error);
  EXPECT_THROW(make_stretched_taps_table(chain, {3, 24, 24, 5}), Error);
  EXPECT_THROW(make_stretched_taps_table({4, 9, LevelLaw::linear}, {}), Error);
  EXPECT_THROW(prepare_split_sum(constant_map(8, 4, 1), f0, 0), Error);
  EXPECT_THROW(prepare_split_sum(constant_map(8, 4, 1), {0, 0, 2}, 0.5), Error);
}

}  // namespace
}  // namespace welkin
