#include <welkin/sphere/cube_edge_fixup.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <welkin/sphere/cube.h>
#include <welkin/sphere/cube_lookup.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

// Smooth on the sphere, between 0.2 and 4, largest slope about 5 a radian.
double smooth(Vec3 d, int channel) {
  const Vec3 n = normalized(d);
  return std::exp(0.8 * std::sin(2 * n.x + channel) + 0.6 * n.y * n.z - 0.4 * n.z + 0.3 * n.x * n.y);
}

Cube smooth_cube(int size) {
  Cube cube(size);
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        for (int c = 0; c < 3; ++c)
          cube.at(face, x, y)[c] = static_cast<float>(smooth(cube_texel_direction(size, face, x, y), c));
  return cube;
}

Cube random_cube(int size) {
  std::mt19937 random(static_cast<unsigned>(size));
  Cube cube(size);
  for (float& v : cube.texels) v = static_cast<float>(random() >> 8) * 0x1p-22f;
  return cube;
}

Vec3 warped_direction(int size, int face, int x, int y) {
  const double last = size - 1;
  return cube_direction({face, 2 * x / last - 1, 2 * y / last - 1});
}

// Relative RMS of a look-up against the function, in random directions.
template <class LookUp>
double lookup_error(LookUp&& look_up) {
  double error = 0, norm = 0;
  for (const Vec3 d : sphere_points(20000, 3)) {
    float value[3];
    look_up(d, value);
    for (int c = 0; c < 3; ++c) {
      const double truth = smooth(d, c);
      error += (static_cast<double>(value[c]) - truth) * (static_cast<double>(value[c]) - truth);
      norm += truth * truth;
    }
  }
  return std::sqrt(error / norm);
}

double face_lookup_error(const Cube& cube, EdgeFixup fixup) {
  return lookup_error([&](Vec3 d, float* out) { look_up_cube_face(cube, d, fixup, out); });
}

constexpr EdgeFixup fixups[] = {EdgeFixup::warp, EdgeFixup::average};

TEST(EdgeFixup, NamesComeBack) {
  for (const EdgeFixup fixup : {EdgeFixup::none, EdgeFixup::warp, EdgeFixup::average})
    EXPECT_EQ(edge_fixup_from_name(edge_fixup_name(fixup)), fixup);
  EXPECT_FALSE(edge_fixup_from_name("seamless"));
}

TEST(EdgeFixup, NoneChangesNothing) {
  const Cube cube = random_cube(5);
  EXPECT_EQ(fix_edges(cube, EdgeFixup::none).texels, cube.texels);
}

// The weights of a cubic add up to 1 but for rounding of doubles, far below that of floats.
TEST(EdgeFixup, ConstantsStay) {
  for (const int size : {1, 2, 3, 4, 9}) {
    Cube cube(size);
    std::fill(cube.texels.begin(), cube.texels.end(), 0.7f);
    for (const EdgeFixup fixup : fixups)
      for (const float v : fix_edges(cube, fixup).texels) ASSERT_FLOAT_EQ(v, 0.7f) << size;
  }
}

// Even of noise: both faces hold the same bits along an edge, and nothing else is used there. The two ways of computing
// the point on an edge differ by rounding of doubles, which the slope between texels carries into floats: 1e-6.
TEST(EdgeFixup, FixedLookUpsAreContinuous) {
  for (const int size : {1, 2, 3, 4, 5, 8, 31}) {
    const Cube cube = random_cube(size);
    EXPECT_GT(face_edge_step(cube, EdgeFixup::none), 0.1) << size;
    for (const EdgeFixup fixup : fixups)
      EXPECT_LT(face_edge_step(fix_edges(cube, fixup), fixup), 1e-6) << size << edge_fixup_name(fixup);
  }
}

// Catmull-Rom errs by O(h^3); where it is held within its neighbours O(h^2); next to corners, where there is no texel
// beyond, O(h): halving h has to cut the largest error by 1.8. A texel that was not moved at all would be off by half a
// step: 0.08 at size 64.
TEST(EdgeFixup, WarpedTexelsHoldTheirDirection) {
  double before = 0;
  for (const int size : {16, 32, 64}) {
    const Cube warped = fix_edges(smooth_cube(size), EdgeFixup::warp);
    double largest = 0;
    for (int face = 0; face < 6; ++face)
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
          for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(static_cast<double>(warped.at(face, x, y)[c]) -
                                                 smooth(warped_direction(size, face, x, y), c)));
    EXPECT_LT(largest, size == 16 ? 0.01 : before / 1.8) << size;
    before = largest;
  }
}

// A sampler that clamps to faces sees the warped cube nearly as well as one that filters across faces sees the plain
// one: the same bilinear error, the texels being wider by N/(N - 1). Without the warp it does worse.
TEST(EdgeFixup, WarpedLookUpsAreAsGoodAsSeamlessOnes) {
  for (const int size : {8, 32}) {
    const Cube cube = smooth_cube(size);
    const double seamless = lookup_error([&](Vec3 d, float* out) { look_up_cube(cube, d, out); });
    const double clamped = face_lookup_error(cube, EdgeFixup::none);
    const double widened = std::pow(size / (size - 1.0), 2);
    EXPECT_LT(face_lookup_error(fix_edges(cube, EdgeFixup::warp), EdgeFixup::warp),
              1.25 * widened * seamless);
    EXPECT_GT(clamped, 1.1 * seamless);
  }
}

// Inside, nothing changes; nothing becomes negative; and what does change stays near the edge's own change.
TEST(EdgeFixup, AverageChangesAFewTexelsOnly) {
  const int size = 24;
  const Cube cube = random_cube(size), fixed = fix_edges(cube, EdgeFixup::average);
  std::size_t changed = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const int inwards = std::min({x, y, size - 1 - x, size - 1 - y});
        const bool same = std::equal(cube.at(face, x, y), cube.at(face, x, y) + 3, fixed.at(face, x, y));
        ASSERT_TRUE(same || inwards < edge_falloff) << x << ' ' << y;
        changed += same ? 0 : 1;
        for (int c = 0; c < 3; ++c) ASSERT_GE(fixed.at(face, x, y)[c], 0.0f);
      }
  EXPECT_GT(changed, 6u * 4 * 2 * 20);  // two rows at least along every edge
}

// The edge between +X and +Z, rows from the top: the last column of +Z touches the first of +X.
TEST(EdgeFixup, AverageIsTheMeanAcrossAnEdge) {
  const Cube cube = random_cube(8), fixed = fix_edges(cube, EdgeFixup::average);
  for (int y = 1; y < 7; ++y)
    for (int c = 0; c < 3; ++c) {
      const float mean = 0.5f * (cube.at(4, 7, y)[c] + cube.at(0, 0, y)[c]);
      EXPECT_FLOAT_EQ(fixed.at(4, 7, y)[c], mean);
      EXPECT_EQ(fixed.at(4, 7, y)[c], fixed.at(0, 0, y)[c]);
    }
  for (int c = 0; c < 3; ++c) {  // the corner of +X, +Y and +Z
    const float mean = (cube.at(4, 7, 0)[c] + cube.at(0, 0, 0)[c] + cube.at(2, 7, 7)[c]) / 3;
    EXPECT_FLOAT_EQ(fixed.at(4, 7, 0)[c], mean);
    EXPECT_EQ(fixed.at(4, 7, 0)[c], fixed.at(0, 0, 0)[c]);
    EXPECT_EQ(fixed.at(4, 7, 0)[c], fixed.at(2, 7, 7)[c]);
  }
}

TEST(EdgeFixup, AllLevelsAreFixed) {
  CubeMips mips;
  for (int size = 8; size > 0; size /= 2) mips.levels.push_back(random_cube(size));
  for (const EdgeFixup fixup : fixups) {
    const CubeMips fixed = fix_edges(mips, fixup);
    ASSERT_EQ(fixed.levels.size(), 4u);
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_EQ(fixed.levels[k].texels, fix_edges(mips.levels[k], fixup).texels);
  }
}

}  // namespace
}  // namespace welkin
