#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/envmap/maps.h>
#include <welkin/brdf/dfg.h>
#include <welkin/brdf/models.h>
#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/reflection/lobe_stack.h>
#include <welkin/error.h>

namespace welkin {
namespace {

double relative_rms(const LobeStack& stack, const std::vector<ReflectionQuery>& queries,
                    const std::vector<double>& truth) {
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const auto value = reflect(stack, queries[i]);
    for (int c = 0; c < 3; ++c) {
      error += std::pow(value[c] - truth[3 * i + c], 2);
      norm += std::pow(truth[3 * i + c], 2);
    }
  }
  return std::sqrt(error / norm);
}

TEST(LobeStack, AConstantEnvironmentGivesTheDirectionalAlbedo) {
  const Image map = constant_map(32, 16, 2);
  const IsotropicBrdf brdf = make_ggx_brdf(0.4, {1, 0.5, 0.04});
  const LobeStack lobes = prepare_lobe_stack(map, brdf, {.views = 12});
  const LobeStack single = prepare_single_lobe(map, brdf, {.views = 12});
  EXPECT_EQ(single.cubes.size(), 1u);
  EXPECT_EQ(lobes.cubes.size(), 12u);
  for (const ReflectionQuery& query : random_reflection_queries(40, 2, 0.1)) {
    const DfgValue dfg = integrate_dfg(dot(query.normal, query.view), 0.4);
    const std::array<double, 3> f0{1, 0.5, 0.04};
    const auto a = reflect(lobes, query), b = reflect(single, query);
    for (int c = 0; c < 3; ++c) {
      // Straight lines between views that are 4 to 12 degrees apart, against Schlick's fifth power.
      EXPECT_NEAR(a[c], 2 * (f0[c] * dfg.scale + dfg.bias), 0.015);
      EXPECT_NEAR(b[c], a[c], 4e-3);  // the same integrals, by rings about other axes
    }
  }
}

TEST(LobeStack, ALobeIsReflectedAsItsFilteredMap) {
  const Image map = noise_map(32, 16, 9);
  const auto queries = random_reflection_queries(30, 4, 0.3);
  const ZonalKernel kernel = make_phong_kernel(30);
  for (bool single : {false, true}) {
    const LobeStackOptions options{.target = LobeTarget::brdf, .views = 6};
    const LobeStack stack = single ? prepare_single_lobe(map, make_phong_brdf(30), options)
                                   : prepare_lobe_stack(map, make_phong_brdf(30), options);
    for (const ReflectionQuery& query : queries) {
      const double cosine = dot(query.normal, query.view);
      const Vec3 mirror = 2 * cosine * query.normal - query.view;
      const auto truth = filter_brute_force(map, std::span(&mirror, 1), std::span(&kernel, 1));
      const auto value = reflect(stack, query);
      // Bilinear with six texels in the half width: (1/6)^2 / 8 of what varies; the axis is good to 1 %.
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], cosine * 32 / 31 * truth[c], 5e-3);
    }
  }
}

TEST(LobeStack, ErrorsAreThoseOfTheDocs) {
  const Image map = sun_map(64, 32, 300);
  const auto queries = random_reflection_queries(40, 1);
  const IsotropicBrdf brdf = make_ggx_brdf(0.5, {1, 1, 1});
  const auto truth = reflect_brute_force(map, brdf, queries);
  const double one = relative_rms(prepare_lobe_stack(map, brdf, {.views = 8}), queries, truth);
  const double two = relative_rms(prepare_lobe_stack(map, brdf, {.lobes = 2, .views = 8}), queries, truth);
  const double single = relative_rms(prepare_single_lobe(map, brdf, {.views = 8}), queries, truth);
  const double outside =
      relative_rms(prepare_lobe_stack(map, brdf, {.target = LobeTarget::brdf, .views = 8}), queries, truth);
  // Upper ends of the docs' table for alpha 0.5.
  EXPECT_LT(one, 0.2);
  EXPECT_LT(two, one);
  EXPECT_LT(single, 0.3);
  EXPECT_GT(outside, one);
}

TEST(LobeStack, SeesNothingFromBelow) {
  const LobeStack stack = prepare_single_lobe(constant_map(16, 8, 1), make_ward_brdf(0.5), {.views = 3});
  EXPECT_EQ(reflect(stack, {{0, 1, 0}, {0, -1, 0}})[0], 0);
  EXPECT_GT(reflect(stack, {{0, 1, 0}, {0, 1, 0}})[0], 0.5);
}

TEST(LobeStack, FilesHaveEveryCubeAndItsPlace) {
  const LobeStack stack =
      prepare_lobe_stack(constant_map(16, 8, 1), make_ward_brdf(0.5), {.lobes = 2, .views = 3});
  const StackFiles files = stack_files(stack);
  ASSERT_EQ(files.cubes.size(), 6u);
  EXPECT_EQ(files.cubes[5].name, "lobe005");
  EXPECT_EQ(files.cubes[5].cube.levels[0].texels, stack.cubes[5].texels);
  EXPECT_NE(files.json.find("\"cube\": 5"), std::string::npos);
  EXPECT_NE(files.json.find("\"brdf\": \"ward alpha 0.5, specular 1\""), std::string::npos);
  EXPECT_EQ(json_string("a\"b\\c\n"), "\"a\\\"b\\\\c\\u000a\"");
}

TEST(LobeStack, BadOptionsAreRefused) {
  const Image map = constant_map(16, 8, 1);
  EXPECT_THROW(prepare_lobe_stack(map, make_ward_brdf(0.5), {.views = 1}), Error);
  EXPECT_THROW(prepare_lobe_stack(map, make_ward_brdf(0.5), {.largest_size = 2}), Error);
  EXPECT_THROW(prepare_single_lobe(map, make_ward_brdf(0.5), {.lobes = 2}), Error);
}

}  // namespace
}  // namespace welkin
