#include <welkin/sphere/cube_mips.h>

#include <gtest/gtest.h>

#include <random>

#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

// Every level holds the energy of the first: only the rounding of texels to float (6e-8) remains, also for one
// bright texel and for sizes that do not halve evenly.
TEST(CubeMips, KeepEnergyAtEveryLevel) {
  std::mt19937 random(5);
  for (int size : {1, 5, 32, 45}) {
    Cube cube(size);
    for (float& value : cube.texels) value = static_cast<float>(random() % 1000) / 500;
    cube.at(size > 2 ? 3 : 0, 0, size / 2)[1] = 1e5f;
    const CubeMips mips = build_mips(cube);
    EXPECT_EQ(mips.levels.back().size, 1);
    const auto expected = map_energy(sphere_map_from_cube(cube));
    for (const Cube& level : mips.levels) {
      const auto energy = map_energy(sphere_map_from_cube(level));
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(energy[c] / expected[c], 1, 2e-7) << level.size;
    }
  }
}

TEST(CubeMips, MakeAsManyLevelsAsAsked) {
  EXPECT_EQ(build_mips(Cube(16), 3).levels.size(), 3u);
  EXPECT_EQ(build_mips(Cube(16), 3).levels[2].size, 4);
  EXPECT_EQ(build_mips(Cube(2), 4).levels.size(), 2u);  // more than there are
  EXPECT_EQ(build_mips(Cube(16)).levels.size(), 5u);
}

// Hand-made: in a 2 x 2 face all texels have equal solid angles by symmetry, so level 1 is their plain mean.
TEST(CubeMips, TwoByTwoIsAPlainMean) {
  Cube cube(2, 1);
  for (int k = 0; k < 4; ++k) cube.at(4, 0, 0)[k] = static_cast<float>(k);
  EXPECT_FLOAT_EQ(build_mips(cube).levels[1].at(4, 0, 0)[0], 1.5f);
}

// By the solid angles of the four texels, one by one; rounding of values below 2 to float.
TEST(CubeMips, AnEvenLevelIsTheMeanOfFourTexels) {
  Cube cube(12);
  std::mt19937 random(8);
  for (float& value : cube.texels) value = static_cast<float>(random() % 1000) / 500;
  const CubeMips mips = build_mips(cube);
  for (int face = 0; face < 6; ++face) {
    for (int k = 0; k < 36; ++k) {
      const int x = k % 6, y = k / 6;
      double sum = 0, total = 0;
      for (int i = 0; i < 4; ++i) {
        const double weight =
            map_texel_solid_angle(map_shape(Mapping::cube, 12), 2 * x + i % 2, 2 * y + i / 2);
        sum += weight * cube.at(face, 2 * x + i % 2, 2 * y + i / 2)[2];
        total += weight;
      }
      EXPECT_NEAR(mips.levels[1].at(face, x, y)[2], sum / total, 1.3e-7);
    }
  }
}

}  // namespace
}  // namespace welkin
