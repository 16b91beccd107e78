#include <welkin/envmap/methods/angular.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../maps.h"

#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/error.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

// The same sum over all texels of the source, with no rectangles.
double red_of_all(const Cube& source, const ZonalKernel& kernel, double radius, Vec3 direction) {
  double sum = 0, weight = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < source.size; ++y)
      for (int x = 0; x < source.size; ++x) {
        const double u = 1 - dot(direction, cube_texel_direction(source.size, face, x, y));
        if (u > 1 - std::cos(radius)) continue;
        const double w = evaluate(kernel, std::max(0.0, u)) * cube_texel_solid_angle(source.size, x, y);
        sum += w * static_cast<double>(source.at(face, x, y)[0]);
        weight += w;
      }
  return sum / weight;
}

// No texel of the cap is missed at any edge or corner: caps from a few texels to a hemisphere, about 384 directions.
TEST(Angular, RectanglesHoldTheWholeCap) {
  const Image map = lamp_map(64, 32, 11);
  AngularOptions options;
  options.source_size = 16;
  const Cube source = equirect_to_cube(map, 16);
  for (const ZonalKernel& kernel : {make_phong_kernel(60), make_phong_kernel(5), make_lambert_kernel()})
    for (double cut : {0.3, 1e-3}) {
      options.cut_energy = cut;
      const Cube cube = filter_angular(map, {kernel, 8, 1}, options);
      const double radius = KernelQuantiles(kernel).angle_with_tail(cut);
      for (int i = 0; i < 384; ++i) {
        const int face = i / 64, x = i % 8, y = i / 8 % 8;
        const double expected = red_of_all(source, kernel, radius, cube_texel_direction(8, face, x, y));
        // Rounding to float; texels at the very rim fall to the same side, but for rounding.
        ASSERT_NEAR(static_cast<double>(cube.at(face, x, y)[0]), expected, 1e-5 * expected)
            << describe(kernel) << ", " << cut;
      }
    }
}

// The artefact: beyond the angle a lamp gives nothing.
TEST(Angular, CutsTheLobe) {
  Image map(64, 32);
  map.at(32, 16)[0] = 1e6f;
  const ZonalKernel kernel = make_phong_kernel(20);
  const double radius = KernelQuantiles(kernel).angle_with_tail(1e-3);
  const Cube cube = filter_angular(map, {kernel, 8, 1});
  const Vec3 lamp{1, 0, 0};
  int dark = 0;
  for (int i = 0; i < 384; ++i) {
    const Vec3 direction = cube_texel_direction(8, i / 64, i % 8, i / 8 % 8);
    if (std::acos(dot(direction, lamp)) < radius + 0.3)
      continue;  // the lamp is 0.1 rad wide, the source's texels 0.1
    ++dark;
    EXPECT_EQ(cube.at(i / 64, i % 8, i / 8 % 8)[0], 0);
  }
  EXPECT_GT(dark, 200);
}

// Narrower than a texel of the source: the nearest one, not 0 / 0.
TEST(Angular, KernelsNarrowerThanATexel) {
  const Cube cube = filter_angular(constant_map(32, 16, 3), {make_ggx_kernel(1e-4), 4, 2});
  for (float value : cube.texels) ASSERT_NEAR(value, 6, 1e-5);
}

TEST(Angular, RefusesOptionsOutOfRange) {
  for (double cut : {0.0, 0.6, std::nan("")}) {
    AngularOptions options;
    options.cut_energy = cut;
    EXPECT_THROW(filter_angular(constant_map(8, 4, 1), {make_lambert_kernel(), 2, 1}, options), Error);
  }
}

}  // namespace
}  // namespace welkin
