#include <welkin/sphere/orientation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <welkin/error.h>
#include <welkin/sphere/labelled_map.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

SphereMap noise(MapShape shape) {
  SphereMap map = make_sphere_map(shape);
  std::mt19937 random(3);
  for (float& value : map.image.pixels) value = static_cast<float>(random() % 1000);
  return map;
}

Label label_in(const SphereMap& map, Vec3 direction) {
  const MapPoint p = map_point(map.shape(), direction);
  const float* texel = map.image.at(static_cast<int>(p.x), static_cast<int>(p.y));
  Label best;
  double least = 1e9;
  for (int k = 0; k < 12; ++k) {
    const auto radiance = label_radiance({k / 2, k % 2 == 1});
    double distance = 0;
    for (int c = 0; c < 3; ++c) distance += std::abs(radiance[static_cast<std::size_t>(c)] - texel[c]);
    if (distance < least) least = distance, best = {k / 2, k % 2 == 1};
  }
  return best;
}

TEST(Orientation, WholeTexelsOfAnEquirectAreMovedBitForBit) {
  const SphereMap map = noise({Mapping::equirectangular, 36, 18});
  for (int k : {1, 5, 35, -3, 40}) {
    const SphereMap turned = rotated_about_y(map, 360.0 / 36 * k);
    for (int y = 0; y < 18; ++y) {
      for (int x = 0; x < 36; ++x) {
        const int to = ((x - k) % 36 + 36) % 36;
        ASSERT_EQ(turned.image.at(to, y)[0], map.image.at(x, y)[0]);
      }
    }
  }
}

// +X goes to -Z, and the ways of turning agree: exact where texels move, resampled everywhere else.
TEST(Orientation, NinetyDegreesTakeEastToNorth) {
  const Vec3 moved = rotation_about_y(90) * Vec3{1, 0, 0};
  EXPECT_EQ(moved.z, -1);
  for (Mapping mapping : all_mappings) {
    const SphereMap turned = rotated_about_y(labelled_map(map_shape(mapping, 64)), 90);
    // (0.8 up: off the letter) East's red is now in the north, south's green in the east.
    EXPECT_EQ(label_in(turned, {0, 0.8, -1}).face, 0) << mapping_name(mapping);
    EXPECT_EQ(label_in(turned, {1, 0.8, 0.01}).face, 4) << mapping_name(mapping);
    EXPECT_EQ(label_in(turned, {0.01, 1, 0.8}).face, 2) << mapping_name(mapping);
  }
}

TEST(Orientation, FourQuarterTurnsAndTwoMirrorsAreNothing) {
  for (Mapping mapping : {Mapping::equirectangular, Mapping::cube, Mapping::octahedral}) {
    const SphereMap map = noise(map_shape(mapping, 12));
    SphereMap turned = map;
    for (int k = 0; k < 4; ++k) turned = rotated_about_y(turned, 90);
    EXPECT_EQ(turned.image.pixels, map.image.pixels);
    EXPECT_NE(rotated_about_y(map, 90).image.pixels, map.image.pixels);
    EXPECT_EQ(mirrored(mirrored(map)).image.pixels, map.image.pixels);
  }
  const SphereMap paraboloids = noise(map_shape(Mapping::dual_paraboloid, 12));
  EXPECT_EQ(mirrored(mirrored(paraboloids)).image.pixels, paraboloids.image.pixels);
}

TEST(Orientation, MirrorExchangesNorthAndSouthAndFlipsTheEquirect) {
  for (Mapping mapping : all_mappings) {
    const SphereMap turned = mirrored(labelled_map(map_shape(mapping, 64)));
    EXPECT_EQ(label_in(turned, {0.01, 0.8, -1}).face, 4) << mapping_name(mapping);
    EXPECT_EQ(label_in(turned, {0.01, 0.8, 1}).face, 5) << mapping_name(mapping);
    EXPECT_EQ(label_in(turned, {1, 0.8, 0.01}).face, 0) << mapping_name(mapping);
  }
  const SphereMap map = noise({Mapping::equirectangular, 9, 4});
  const SphereMap flipped = mirrored(map);
  for (int x = 0; x < 9; ++x) EXPECT_EQ(flipped.image.at(x, 2)[1], map.image.at(8 - x, 2)[1]);
}

TEST(Orientation, AnyRotationKeepsEnergyAndOthersAreRefused) {
  const SphereMap map = noise(map_shape(Mapping::cube, 24));
  const SphereMap turned = rotated_about_y(map, 33);
  const auto before = map_energy(map), after = map_energy(turned);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(after[c] / before[c], 1, 1e-6);  // rounding to float
  EXPECT_THROW(oriented(map, {{Vec3{2, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}), Error);
}

TEST(Orientation, NumbersThatAreNoAngleAreRefused) {
  const SphereMap map = noise(map_shape(Mapping::equirectangular, 4));
  for (const double degrees : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_THROW(rotation_about_y(degrees), Error);
    EXPECT_THROW(rotated_about_y(map, degrees), Error);
  }
  EXPECT_THROW(oriented(map, {{Vec3{std::nan(""), 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}), Error);
}

}  // namespace
}  // namespace welkin
