#include <welkin/sh/lookup.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "test_maps.h"

#include <welkin/error.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/folded_lookup.h>
#include <welkin/sh/map_projection.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// Tables are float: 6e-8 of each term, which are of both signs and at most the largest coefficient together.
TEST(Lookup, ProjectsAsTheMapProjectionDoes) {
  for (Mapping mapping : all_mappings) {
    const SphereMap map = random_map(map_shape(mapping, 12), 3);
    const std::vector<double> truth = project_map(map, 5, TexelRule::centre).values;
    const auto lookup = make_sh_projection_lookup(map.shape(), 5);
    EXPECT_LT(largest_difference(project(lookup, map).values, truth), 3e-7 * largest_of(truth));
  }
  for (Mapping mapping : {Mapping::cube, Mapping::dual_paraboloid}) {
    const SphereMap map = random_map(map_shape(mapping, 12), 3);
    const std::vector<double> truth = project_map(map, 5).values;
    const auto lookup = make_sh_projection_lookup(map.shape(), 5, TexelRule::integrated);
    EXPECT_LT(largest_difference(project(lookup, map).values, truth), 3e-7 * largest_of(truth));
  }
}

TEST(Lookup, SynthesizesAsEvaluateDoes) {
  ShCoefficients coefficients(2, 2);
  for (std::size_t i = 0; i < coefficients.values.size(); ++i)
    coefficients.values[i] = std::cos(static_cast<double>(i));
  const MapShape shape = map_shape(Mapping::dual_paraboloid, 6);
  const SphereMap map = synthesize(make_sh_synthesis_lookup(shape, 4), coefficients);
  double value[2];
  evaluate(coefficients, map_texel_direction(shape, 9, 2), value);
  EXPECT_NEAR(map.image.at(9, 2)[0], value[0], 1e-6);
  EXPECT_NEAR(map.image.at(9, 2)[1], value[1], 1e-6);
}

// The folded tables against the complete ones. Float sums of up to 6 * 33^2 random terms: 2e-6 of the largest
// coefficient.
void expect_projection(MapShape shape, int channels, int degree, TexelRule rule) {
  const SphereMap map = random_map(shape, channels);
  const std::vector<double> truth = project(make_sh_projection_lookup(shape, degree, rule), map).values;
  ShCoefficients result;
  project(make_sh_projection_table(shape, degree, channels, rule), map, result);
  EXPECT_LT(largest_difference(result.values, truth), 2e-6 * largest_of(truth))
      << mapping_name(shape.mapping) << ' ' << shape.height << ' ' << channels << ' ' << degree;
}

// Sizes even and odd, smaller than and no multiple of a vector.
TEST(FoldedLookup, ProjectsAsTheCompleteTable) {
  for (Mapping mapping : {Mapping::cube, Mapping::dual_paraboloid}) {
    for (int channels = 1; channels <= 4; ++channels) {
      for (int degree : {0, 1, 2, 3, 8}) {
        for (int size : {1, 2, 16, 33})
          expect_projection(map_shape(mapping, size), channels, degree, TexelRule::centre);
        expect_projection(map_shape(mapping, 3), channels, degree, TexelRule::integrated);
      }
    }
  }
}

TEST(FoldedLookup, SynthesizesAsTheCompleteTable) {
  for (Mapping mapping : {Mapping::cube, Mapping::dual_paraboloid}) {
    for (int size : {1, 2, 16, 33}) {
      for (int channels = 1; channels <= 4; ++channels) {
        for (int degree : {0, 1, 2, 8}) {
          ShCoefficients coefficients(degree, channels);
          for (std::size_t i = 0; i < coefficients.values.size(); ++i)
            coefficients.values[i] = std::cos(1.7 * static_cast<double>(i));
          const MapShape shape = map_shape(mapping, size);
          const SphereMap truth = synthesize(make_sh_synthesis_lookup(shape, degree), coefficients);
          SphereMap result;
          synthesize(make_sh_synthesis_table(shape, degree, channels), coefficients, result);
          EXPECT_LT(largest_difference(result.image.pixels, truth.image.pixels),
                    2e-6 * largest_of(truth.image.pixels) + 1e-6)
              << mapping_name(mapping) << ' ' << size << ' ' << channels << ' ' << degree;
        }
      }
    }
  }
}

// L = 1 + w . d has irradiance pi + (2 pi/3) w . n: the whole way round, world axes and factors included. The centre
// rule on 64 texels is off by (1/32)^2 / 24 of second derivatives, about 1e-4.
TEST(FoldedLookup, RoundTripOfARampIsItsIrradiance) {
  const Vec3 w{0.2, 0.5, -0.7};
  const Cube radiance = cube_from_sphere_map(
      sphere_map_of(map_shape(Mapping::cube, 64), 3, [&](Vec3 d, int c) { return 1 + (c + 1) * dot(w, d); }));
  ShCoefficients coefficients;
  project(make_sh_projection_table(64), radiance, coefficients);
  Cube irradiance;
  synthesize(make_sh_synthesis_table(32), convolve(coefficients, cosine_lobe(2)), irradiance);
  ASSERT_EQ(irradiance.size, 32);
  double largest = 0;
  const MapShape shape = map_shape(Mapping::cube, 32);
  for (int y = 0; y < 6 * 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c)
        largest =
            std::max(largest, std::abs(irradiance.texels[(y * 32 + x) * 3 + c] - pi -
                                       2 * pi / 3 * (c + 1) * dot(w, map_texel_direction(shape, x, y))));
  EXPECT_LT(largest, 2e-3);
}

// What was in the output before does not matter, nor does a run before it.
TEST(FoldedLookup, OutputsAreOverwritten) {
  const Cube cube = cube_from_sphere_map(random_map(map_shape(Mapping::cube, 8), 3));
  const auto table = make_sh_projection_table(8);
  ShCoefficients fresh, used(7, 1);
  std::fill(used.values.begin(), used.values.end(), 5.0);
  project(table, cube, fresh);
  project(table, cube, used);
  EXPECT_EQ(fresh.values, used.values);
  EXPECT_EQ(used.max_degree, 2);
  const auto synthesis = make_sh_synthesis_table(4);
  Cube fresh_cube, used_cube(9, 1);
  synthesize(synthesis, fresh, fresh_cube);
  synthesize(synthesis, fresh, used_cube);
  EXPECT_EQ(fresh_cube.texels, used_cube.texels);
  EXPECT_EQ(used_cube.channels, 3);
}

TEST(FoldedLookup, MissingDegreesAreZeroAndHigherOnesLeftOut) {
  ShCoefficients one(1, 1), three(3, 1);
  one.values = {1, 2, 3, 4};
  std::copy(one.values.begin(), one.values.end(), three.values.begin());
  three.values[sh_index(3, 1)] = 7;
  Cube from_one, from_three;
  synthesize(make_sh_synthesis_table(4, 2, 1), one, from_one);
  synthesize(make_sh_synthesis_table(4, 2, 1), three, from_three);
  EXPECT_EQ(from_one.texels, from_three.texels);
}

TEST(Lookup, RefusesWhatDoesNotFit) {
  EXPECT_THROW(make_sh_projection_lookup(map_shape(Mapping::cube, 4), max_lookup_degree + 1), Error);
  EXPECT_THROW(make_sh_projection_lookup(map_shape(Mapping::octahedral, 4), 2, TexelRule::integrated), Error);
  EXPECT_THROW(make_sh_projection_table(map_shape(Mapping::octahedral, 4)), Error);
  EXPECT_THROW(make_sh_projection_table(0), Error);
  EXPECT_THROW(make_sh_projection_table(4, -1), Error);
  EXPECT_THROW(make_sh_projection_table(4, 2, 5), Error);
  EXPECT_THROW(project(make_sh_projection_lookup(map_shape(Mapping::cube, 4)), Cube(8)), Error);
  ShCoefficients out;
  EXPECT_THROW(project(make_sh_projection_table(4), Cube(8), out), Error);
  EXPECT_THROW(project(make_sh_projection_table(4), Cube(4, 1), out), Error);
  Cube cube;
  EXPECT_THROW(synthesize(make_sh_synthesis_table(4), ShCoefficients(2, 1), cube), Error);
  EXPECT_THROW(
      synthesize(make_sh_synthesis_table(map_shape(Mapping::dual_paraboloid, 4)), ShCoefficients(2, 3), cube),
      Error);
}

}  // namespace
}  // namespace welkin
