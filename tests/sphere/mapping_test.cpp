#include <welkin/sphere/mapping.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

std::vector<Vec3> probe_directions() {
  std::vector<Vec3> directions = sphere_points(20'000, 1);
  for (double x : {-1.0, 0.0, 1.0}) {
    for (double y : {-1.0, 0.0, 1.0}) {
      for (double z : {-1.0, 0.0, 1.0}) {
        if (x == 0 && y == 0 && z == 0) continue;
        directions.push_back(normalized({x, y, z}));
        for (double off : {1e-3, 1e-7, 1e-12})
          directions.push_back(normalized({x + off, y - 2 * off, z + 3 * off}));
      }
    }
  }
  return directions;
}

Vec3 direction_of(MapShape shape, MapPoint p) {
  const int x = std::clamp(static_cast<int>(p.x), 0, shape.width - 1);
  int y = std::clamp(static_cast<int>(p.y), 0, shape.height - 1);
  if (shape.mapping == Mapping::cube)
    y = std::clamp(y, (p.chart - 1) * shape.width, p.chart * shape.width - 1);
  int column = x;
  if (shape.mapping == Mapping::dual_paraboloid && p.chart == 1) column = std::min(x, shape.height - 1);
  return map_texel_direction(shape, column, y, p.x - column, p.y - y);
}

// Axes, diagonals (cube corners and edges, the rim, the folds), near misses of them, and points all over. 1e-12 is
// thousands of roundings; the ball is the exception near -Z, where its whole rim is one direction and rounding of
// the position by 1e-16 moves the direction by its root, 2e-8.
TEST(Mapping, DirectionSurvivesThePictureAndBack) {
  for (Mapping mapping : all_mappings) {
    const MapShape shape = map_shape(mapping, 64);
    for (Vec3 d : probe_directions()) {
      const MapPoint p = map_point(shape, d);
      ASSERT_GE(p.x, 0);
      ASSERT_GE(p.y, 0);
      ASSERT_LE(p.x, shape.width);
      ASSERT_LE(p.y, shape.height);
      const bool singular = mapping == Mapping::mirror_ball && d.z < -0.999;
      ASSERT_LT(length(direction_of(shape, p) - d), singular ? 1e-7 : 1e-12)
          << mapping_name(mapping) << " " << d.x << " " << d.y << " " << d.z;
    }
  }
}

// Published or drawn positions, so that both functions cannot be wrong together.
TEST(Mapping, AxesLieWhereTheDocumentationPutsThem) {
  const auto at = [](Mapping mapping, Vec3 d) { return map_point(map_shape(mapping, 8), d); };
  EXPECT_NEAR(at(Mapping::equirectangular, {1, 0, 0}).x, 8, 1e-12);
  EXPECT_NEAR(at(Mapping::equirectangular, {0, 0, 1}).x, 12, 1e-12);
  EXPECT_NEAR(at(Mapping::equirectangular, {0, 1, 0}).y, 0, 1e-12);
  EXPECT_NEAR(at(Mapping::cube, {0, 0, 1}).y, 4 * 8 + 4, 1e-12);
  EXPECT_NEAR(at(Mapping::dual_paraboloid, {0, 0, 1}).x, 4, 1e-12);
  EXPECT_NEAR(at(Mapping::dual_paraboloid, {0, 0, -1}).x, 12, 1e-12);
  EXPECT_NEAR(at(Mapping::dual_paraboloid, {0, 1, 0}).y, 0, 1e-12);
  EXPECT_NEAR(at(Mapping::mirror_ball, {0, 0, 1}).x, 4, 1e-12);
  // n = (d + z)/|d + z| of +X is (1, 0, 1)/sqrt(2).
  EXPECT_NEAR(at(Mapping::mirror_ball, {1, 0, 0}).x, 4 + 4 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(at(Mapping::octahedral, {0, 1, 0}).x, 4, 1e-12);
  EXPECT_NEAR(at(Mapping::octahedral, {1, 0, 0}).x, 8, 1e-12);
  EXPECT_NEAR(at(Mapping::octahedral, {0, 0, 1}).y, 8, 1e-12);
  EXPECT_NEAR(std::abs(at(Mapping::octahedral, {0, -1, 0}).x - 4), 4, 1e-12);
}

TEST(Mapping, TexelSolidAnglesSumToTheSphere) {
  for (Mapping mapping : all_mappings) {
    for (int size : {1, 2, 3, 7, 64, 129}) {
      const MapShape shape = map_shape(mapping, size);
      double sum = 0;
      for (int y = 0; y < shape.height; ++y) {
        for (int x = 0; x < shape.width; ++x) sum += map_texel_solid_angle(shape, x, y);
      }
      EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-10) << mapping_name(mapping) << " " << size;
    }
  }
}

// The area of the quadrilateral of directions around a point, by differences of map_texel_direction alone.
double local_density(MapShape shape, int x, int y, double fx, double fy) {
  constexpr double step = 1e-4;
  const Vec3 dx =
      map_texel_direction(shape, x, y, fx + step, fy) - map_texel_direction(shape, x, y, fx - step, fy);
  const Vec3 dy =
      map_texel_direction(shape, x, y, fx, fy + step) - map_texel_direction(shape, x, y, fx, fy - step);
  return length(cross(dx, dy)) / (4 * step * step);
}

// Midpoint sums with n^2 points: 1e-4 for whole texels (n^-2 and the difference step); texels on a rim are cut by a
// circle that the points only resolve to about 1/n of the texel.
TEST(Mapping, TexelSolidAnglesAreTheIntegralOfTheJacobian) {
  constexpr int n = 40;
  for (Mapping mapping : all_mappings) {
    const MapShape shape = map_shape(mapping, 6);
    const double mean = 4 * std::numbers::pi / (shape.width * shape.height);
    for (int y = 0; y < shape.height; ++y) {
      for (int x = 0; x < shape.width; ++x) {
        double sum = 0;
        int inside = 0;
        for (int k = 0; k < n * n; ++k) {
          const double fx = (k % n + 0.5) / n, fy = (k / n + 0.5) / n;
          if (!map_covers(shape, x, y, fx, fy)) continue;
          sum += local_density(shape, x, y, fx, fy) / (n * n);
          ++inside;
        }
        const double tolerance = inside == n * n ? 1e-3 : 2e-2;
        EXPECT_NEAR(map_texel_solid_angle(shape, x, y), sum, tolerance * mean)
            << mapping_name(mapping) << " " << x << " " << y;
      }
    }
  }
}

TEST(Mapping, DensityIsTheSolidAngleOfATinyTexel) {
  for (Mapping mapping : all_mappings) {
    const MapShape shape = map_shape(mapping, 512);
    for (Vec3 d : sphere_points(500, 2)) {
      const MapPoint p = map_point(shape, d);
      const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
      const double exact = map_texel_solid_angle(shape, x, y);
      const bool whole = map_covers(shape, x, y, 0, 0) && map_covers(shape, x, y, 1, 1) &&
                         map_covers(shape, x, y, 0, 1) && map_covers(shape, x, y, 1, 0);
      // The density varies by up to 1/theta per radian; beside a pole a texel is too large to be tiny. 5e-3: a fold
      // through an octahedral texel leaves a first-order error, a quarter of a texel times d(log density), 3 / radian.
      const double expected =
          whole && std::abs(d.y) < 0.99 ? map_density(shape, map_texel_direction(shape, x, y)) : exact;
      EXPECT_NEAR(expected / exact, 1, 5e-3) << mapping_name(mapping);
    }
  }
}

TEST(Mapping, RowsOfSolidAnglesAgreeWithSingleOnes) {
  std::vector<double> row;
  for (Mapping mapping : all_mappings) {
    const MapShape shape = map_shape(mapping, 33);
    for (int y = 0; y < shape.height; ++y) {
      map_row_solid_angles(shape, y, row);
      for (int x = 0; x < shape.width; ++x) {
        ASSERT_NEAR(row[static_cast<std::size_t>(x)], map_texel_solid_angle(shape, x, y), 1e-15);
      }
    }
  }
}

// The border rule of the octahedral map: what lies left of (0, j) is (0, N - 1 - j), and so on.
TEST(Mapping, OctahedralBorderContinuesOnItself) {
  const MapShape shape = map_shape(Mapping::octahedral, 16);
  for (int j = 0; j < 16; ++j) {
    for (double f : {0.0, 0.25, 0.5}) {
      EXPECT_LT(
          length(map_texel_direction(shape, 0, j, 0, f) - map_texel_direction(shape, 0, 15 - j, 0, 1 - f)),
          1e-15);
      EXPECT_LT(
          length(map_texel_direction(shape, j, 15, f, 1) - map_texel_direction(shape, 15 - j, 15, 1 - f, 1)),
          1e-15);
    }
  }
}

TEST(Mapping, NamesGoThereAndBack) {
  for (Mapping mapping : all_mappings) EXPECT_EQ(mapping_from_name(mapping_name(mapping)), mapping);
  EXPECT_EQ(mapping_from_name("latlong"), Mapping::equirectangular);
  EXPECT_EQ(mapping_from_name("mercator"), std::nullopt);
}

TEST(Mapping, ImpossibleShapesAreRefused) {
  EXPECT_THROW(check_map_shape({Mapping::cube, 4, 23}), Error);
  EXPECT_THROW(check_map_shape({Mapping::octahedral, 4, 5}), Error);
  EXPECT_THROW(check_map_shape({Mapping::dual_paraboloid, 4, 4}), Error);
  EXPECT_THROW(check_map_shape({Mapping::equirectangular, 0, 4}), Error);
  EXPECT_THROW(check_map_shape({Mapping::equirectangular, 100'000, 100'000}), Error);
  EXPECT_NO_THROW(check_map_shape({Mapping::equirectangular, 5, 4}));
}

}  // namespace
}  // namespace welkin
