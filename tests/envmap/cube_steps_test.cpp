#include <welkin/envmap/cube_steps.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/sphere/cube.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

double smooth(Vec3 d) { return 2 + d.x * d.y + 0.5 * d.z - 0.3 * d.x * d.x * d.z; }

Cube cube_of(int size, double step_on_face_2) {
  Cube cube(size);
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        for (int c = 0; c < 3; ++c)
          cube.at(face, x, y)[c] = static_cast<float>(smooth(cube_texel_direction(size, face, x, y)) +
                                                      (face == 2 ? step_on_face_2 : 0));
  return cube;
}

TEST(EdgeStep, IsOneForASmoothFunctionAndMoreForASeam) {
  // Extrapolation is exact for cubics along a line; on a coarse cube the sphere bends away within five texels.
  EXPECT_NEAR(edge_step_ratio(cube_of(8, 0)), 1, 0.05);
  EXPECT_NEAR(edge_step_ratio(cube_of(64, 0)), 1, 0.01);
  EXPECT_NEAR(edge_step_ratio(cube_of(256, 0)), 1, 0.01);
  EXPECT_GT(edge_step_ratio(cube_of(64, 0.1)), 1.5);
  EXPECT_EQ(edge_step_ratio(cube_of(4, 0)), 0);
  EXPECT_EQ(edge_step_ratio(Cube(8)), 0);
}

// smooth() integrates to 8 pi: every term but the constant is odd in some axis.
TEST(CubeEnergy, IsTheIntegral) {
  Cube skewed(16);
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const Vec3 d = cube_texel_direction(16, face, x, y);
        for (int c = 0; c < 3; ++c) skewed.at(face, x, y)[c] = static_cast<float>(std::exp(3 * (d.x - 1)));
      }
  // 2 pi integral over [-1, 1] of e^(3 (x - 1)) dx; h^4 terms of a function that varies over a third of a radian.
  EXPECT_NEAR(cube_energy(skewed) / (2 * std::numbers::pi * (1 - std::exp(-6.0)) / 3), 1, 1e-4);
  EXPECT_NEAR(cube_energy(cube_of(64, 0)), 8 * std::numbers::pi, 1e-5);
  EXPECT_NEAR(cube_energy(cube_of(1, 0)), 8 * std::numbers::pi, 1e-5);
}

// Bilinear interpolation is off by the second derivative times the texel size squared over 8.
TEST(CubeLookUp, IsSmoothAcrossEdgesAndCorners) {
  double worst[2];
  for (int i = 0; i < 2; ++i) {
    const Cube cube = cube_of(16 << i, 0);
    worst[i] = 0;
    std::vector<Vec3> directions = sphere_points(3000);
    for (double sx : {-1.0, 1.0})
      for (double sy : {-1.0, 1.0})
        for (double sz : {-1.0, 1.0}) directions.push_back(normalized({sx, sy * 1.0001, sz * 0.9999}));
    for (const Vec3& d : directions) {
      float value[3];
      look_up_cube(cube, d, value);
      worst[i] = std::max(worst[i], std::abs(static_cast<double>(value[0]) - smooth(d)));
    }
  }
  EXPECT_LT(worst[0], 0.02);
  EXPECT_LT(worst[1], 0.7 * worst[0]);  // edges and corners converge more slowly than the square
}

TEST(CubeLookUp, ReturnsTexelsAtTheirCentresAndBlendsLevels) {
  CubeMips mips{{cube_of(8, 0), cube_of(4, 1)}};
  const Vec3 d = cube_texel_direction(8, 3, 2, 5);
  float value[3];
  look_up_cube(mips, d, 0, value);
  EXPECT_NEAR(value[0], mips.levels[0].at(3, 2, 5)[0], 1e-5);
  float low[3], high[3];
  look_up_cube(mips.levels[0], {0.2, 0.9, -0.1}, low);
  look_up_cube(mips.levels[1], {0.2, 0.9, -0.1}, high);
  look_up_cube(mips, {0.2, 0.9, -0.1}, 0.25, value);
  EXPECT_NEAR(value[1], 0.75 * static_cast<double>(low[1]) + 0.25 * static_cast<double>(high[1]), 1e-5);
  look_up_cube(mips, {0.2, 0.9, -0.1}, 99, value);
  EXPECT_EQ(value[1], high[1]);
}

}  // namespace
}  // namespace welkin
