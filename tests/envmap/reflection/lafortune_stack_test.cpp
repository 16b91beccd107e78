#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <tests/envmap/maps.h>
#include <welkin/envmap/brute_force.h>
#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/error.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

TEST(LafortuneStack, LevelsAreExponents) {
  const LafortuneStack stack = prepare_lafortune_stack(constant_map(16, 8, 3), {.largest_exponent = 64});
  ASSERT_EQ(stack.exponents, (std::vector<double>{64, 16, 4, 1, 0}));
  ASSERT_EQ(stack.glossy.levels.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(lafortune_level(stack, stack.exponents[k]), static_cast<double>(k), 1e-12);
  EXPECT_EQ(lafortune_level(stack, 1000), 0);
  // Halfway between 1/(16 + 2) and 1/(64 + 2): the mean cosine of the blend is that of the exponent.
  const double middle = 2 / (1 / 18.0 + 1 / 66.0) - 2;
  EXPECT_NEAR(lafortune_level(stack, middle), 0.5, 1e-12);
}

TEST(LafortuneStack, AConstantEnvironmentIsTheClosedForm) {
  const LafortuneStack stack = prepare_lafortune_stack(constant_map(16, 8, 2), {.largest_exponent = 64});
  const LafortuneBrdf brdf = parse_lafortune("-0.9:-0.5:0.8:12:0.5:1:2,diffuse:0.25");
  for (const TangentQuery& query : with_tangents(random_reflection_queries(20, 7))) {
    const Vec3 bitangent = cross(query.normal, query.tangent);
    const Vec3 r{-0.9 * dot(query.view, query.tangent), -0.5 * dot(query.view, bitangent),
                 0.8 * dot(query.view, query.normal)};
    const auto value = reflect(stack, brdf, query);
    const double lobe = 14.0 / 13 * std::pow(length(r), 12) * r.z / length(r);
    EXPECT_NEAR(value[0], 2 * (0.25 + 0.5 * lobe),
                1e-4);  // floats, and the filter's 3e-4 of the mean at most
    EXPECT_NEAR(value[2], 2 * (0.25 + 2 * lobe), 3e-4);
  }
}

TEST(LafortuneStack, MinusOneMinusOneOneIsThePhongMapAboutTheMirrorDirection) {
  const Image map = noise_map(32, 16, 3);
  const LafortuneStack stack = prepare_lafortune_stack(map, {.largest_exponent = 64});
  const LafortuneBrdf brdf = parse_lafortune("-1:-1:1:16");
  const ZonalKernel kernel = make_phong_kernel(16);
  for (const ReflectionQuery& query : random_reflection_queries(30, 5)) {
    const double cosine = dot(query.normal, query.view);
    const Vec3 mirror = 2 * cosine * query.normal - query.view;
    const auto truth = filter_brute_force(map, std::span(&mirror, 1), std::span(&kernel, 1));
    const auto value = reflect(stack, brdf, query);
    // Bilinear in a level with four texels in 1/sqrt(N): of noise that is filtered to +-0.1 of its mean of 1.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], cosine * 18 / 17 * truth[c], 5e-3);
  }
}

TEST(LafortuneTruth, AgreesWithTheOracleOfIsotropicBrdfs) {
  const Image map = sun_map(48, 24, 200);
  const auto queries = random_reflection_queries(20, 8);
  const LafortuneBrdf brdf = parse_lafortune("-0.9:-0.9:1:25:0.5,0.6:0.6:0.9:3:0.3,diffuse:0.2");
  const auto a = reflect_lafortune_brute_force(map, brdf, with_tangents(queries));
  const auto b = reflect_brute_force(map, make_lafortune_brdf(brdf), queries);
  // Gauss nodes on texels that the horizon cuts: both are off by 1e-3 of such a texel.
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 2e-3 * b[i]);
}

double relative_rms(const std::vector<double>& truth, const LafortuneStack& stack, const LafortuneBrdf& brdf,
                    const std::vector<TangentQuery>& queries) {
  double error = 0, norm = 0;
  for (std::size_t i = 0; i < queries.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      error += std::pow(reflect(stack, brdf, queries[i])[c] - truth[3 * i + c], 2);
      norm += std::pow(truth[3 * i + c], 2);
    }
  return std::sqrt(error / norm);
}

// The cosine outside of the integral costs what docs/reflection.md says: little for sharp lobes, much for wide ones.
TEST(LafortuneStack, ErrorAgainstTheFullIntegralFallsWithTheExponent) {
  const Image map = sun_map(64, 32, 100);
  const LafortuneStack stack = prepare_lafortune_stack(map);
  const auto queries = with_tangents(random_reflection_queries(50, 6, 0.2));
  const auto error = [&](const char* text) {
    const LafortuneBrdf brdf = parse_lafortune(text);
    return relative_rms(reflect_lafortune_brute_force(map, brdf, queries), stack, brdf, queries);
  };
  const double wide = error("-1:-1:1:1"), middle = error("-1:-0.8:1:16"), sharp = error("-1:-1:1:256");
  EXPECT_GT(wide, 0.2);
  EXPECT_LT(wide, 0.8);
  EXPECT_LT(middle, 0.4);
  EXPECT_LT(sharp, 0.1);
}

TEST(LafortuneStack, SeesNothingFromBelowAndAxesBelowReflectNothing) {
  const LafortuneStack stack = prepare_lafortune_stack(constant_map(16, 8, 1), {.largest_exponent = 16});
  const LafortuneBrdf brdf = parse_lafortune("-1:-1:1:16");
  EXPECT_EQ(reflect(stack, brdf, ReflectionQuery{{0, 1, 0}, {0, -1, 0}})[0], 0);
  EXPECT_EQ(reflect(stack, parse_lafortune("-1:-1:-1:16"), ReflectionQuery{{0, 1, 0}, {0.6, 0.8, 0}})[0], 0);
  EXPECT_NEAR(reflect(stack, brdf, ReflectionQuery{{0, 1, 0}, {0, 1, 0}})[0], 18.0 / 17, 1e-4);
}

TEST(LafortuneStack, FilesAndOptions) {
  const Image map = constant_map(16, 8, 1);
  const StackFiles files = stack_files(prepare_lafortune_stack(map, {.largest_exponent = 16}));
  ASSERT_EQ(files.cubes.size(), 2u);
  EXPECT_EQ(files.cubes[0].cube.levels.size(), 4u);
  EXPECT_NE(files.json.find("\"exponents\": [16, 4, 1, 0]"), std::string::npos);
  EXPECT_THROW(prepare_lafortune_stack(map, {.largest_exponent = 0.5}), Error);
  EXPECT_THROW(prepare_lafortune_stack(map, {.size = 3}), Error);
}

}  // namespace
}  // namespace welkin
