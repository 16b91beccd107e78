#include <welkin/sh/map_projection.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "test_maps.h"

#include <welkin/error.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/labelled_map.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// The integral of the direction over a spherical polygon: half the sum over its edges of the angle they subtend times
// the unit normal of their plane (Lambert 1760).
Vec3 polygon_vector(std::span<const Vec3> corners) {
  Vec3 sum{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = corners[i], b = corners[(i + 1) % corners.size()], normal = cross(a, b);
    sum = sum + 0.5 * std::atan2(length(normal), dot(a, b)) * normalized(normal);
  }
  return sum;
}

TEST(TexelNodes, WeightsAddUpToTheSolidAngle) {
  for (Mapping mapping : {Mapping::cube, Mapping::dual_paraboloid}) {
    for (int size : {1, 2, 3, 7, 16, 40}) {
      const MapShape shape = map_shape(mapping, size);
      TexelNodes nodes(shape, 4, TexelRule::integrated);
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < shape.width; ++x) {
          double sum = 0;
          for (const TexelNode& node : nodes.of(x, y)) sum += node.weight;
          EXPECT_NEAR(sum, map_texel_solid_angle(shape, x, y), 2e-12) << size << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

// Degree 1 is the integral of x, y and z over the texel, which Lambert's formula gives for polygons.
TEST(TexelNodes, OfCubesGiveLambertsFormula) {
  for (int size : {1, 2, 5}) {
    TexelNodes nodes(map_shape(Mapping::cube, size), 1, TexelRule::integrated);
    for (int y = 0; y < 6 * size; ++y) {
      for (int x = 0; x < size; ++x) {
        const auto corner = [&](int dx, int dy) {
          return cube_direction({y / size, 2.0 * (x + dx) / size - 1, 2.0 * (y % size + dy) / size - 1});
        };
        const Vec3 corners[] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
        Vec3 sum{};
        for (const TexelNode& node : nodes.of(x, y)) sum = sum + node.weight * nodes.direction(x, y, node);
        const Vec3 truth = polygon_vector(corners);
        // The corners run clockwise or not, by the face: the sign is that of the direction.
        EXPECT_NEAR(length(sum), length(truth), 1e-12);
        EXPECT_NEAR(length(cross(sum, truth)), 0, 1e-12);
        EXPECT_GT(dot(sum, corners[0]), 0);
      }
    }
  }
}

// A rim texel against a fine grid of points, whose own error is about its cells along the arc (1/300 of a texel's 0.05 sr at most).
TEST(TexelNodes, OnTheRimAgreeWithAFineGrid) {
  const int size = 9, fine = 300;
  const MapShape shape = map_shape(Mapping::dual_paraboloid, size);
  TexelNodes nodes(shape, 3, TexelRule::integrated);
  for (const auto& [x, y] : {std::pair{1, 1}, {0, 4}, {10, 7}, {13, 0}}) {
    std::vector<double> basis(16), sum(16), truth(16);
    for (const TexelNode& node : nodes.of(x, y)) {
      evaluate_sh_basis(nodes.direction(x, y, node), 3, basis);
      for (int i = 0; i < 16; ++i) sum[i] += node.weight * basis[i];
    }
    for (int k = 0; k < fine * fine; ++k) {
      const double fx = (k % fine + 0.5) / fine, fy = (k / fine + 0.5) / fine;
      if (!map_covers(shape, x, y, fx, fy)) continue;
      const Vec3 direction = map_texel_direction(shape, x, y, fx, fy);
      evaluate_sh_basis(direction, 3, basis);
      for (int i = 0; i < 16; ++i) truth[i] += map_density(shape, direction) / fine / fine * basis[i];
    }
    EXPECT_GT(truth[0], 1e-3);
    EXPECT_LT(largest_difference(sum, truth), 0.05 / 300);
  }
}

TEST(MapProjection, OfAConstantHasDegreeZeroOnly) {
  for (MapShape shape : {map_shape(Mapping::cube, 1), map_shape(Mapping::cube, 4),
                         map_shape(Mapping::dual_paraboloid, 1), map_shape(Mapping::dual_paraboloid, 12)}) {
    const SphereMap map = sphere_map_of(shape, 1, [](Vec3, int) { return 1; });
    std::vector<double> truth(sh_count(20));
    truth[0] = std::sqrt(4 * pi);
    EXPECT_LT(largest_difference(project_map(map, 20).values, truth), 1e-11);
  }
}

// Half the sphere: the integral of Y_10 over z > 0 is sqrt(3 / 4 pi) pi, of Y_30 sqrt(7 / 4 pi) (-pi/4); even degrees
// but 0 vanish. One face: the integral of z over +Z is sqrt2 acos(1/3), by Lambert's formula for its four edges.
TEST(MapProjection, OfOneSideLit) {
  const auto upper = [](Vec3 d, int) { return d.z > 0 ? 1 : 0; };
  SphereMap discs = make_sphere_map(map_shape(Mapping::dual_paraboloid, 10), 1);
  for (int y = 0; y < 10; ++y) std::fill_n(discs.image.at(0, y), 10, 1.0f);
  for (const SphereMap& map : {discs, sphere_map_of(map_shape(Mapping::cube, 10), 1, upper)}) {
    const ShCoefficients half = project_map(map, 4);
    EXPECT_NEAR(half.values[0], std::sqrt(pi), 1e-11);
    EXPECT_NEAR(half.values[sh_index(1, 0)], std::sqrt(3 / (4 * pi)) * pi, 1e-11);
    EXPECT_NEAR(half.values[sh_index(2, 0)], 0, 1e-11);
    EXPECT_NEAR(half.values[sh_index(3, 0)], std::sqrt(7 / (4 * pi)) * -pi / 4, 1e-11);
    EXPECT_NEAR(half.values[sh_index(3, 2)], 0, 1e-11);
  }
  Cube face(8, 1);
  std::fill_n(face.at(4, 0, 0), 64, 1.0f);
  EXPECT_NEAR(project_cube(face, 1).values[sh_index(1, 0)],
              std::sqrt(3 / (4 * pi)) * std::sqrt(2) * std::acos(1.0 / 3), 1e-12);
}

// The usual way converges to the exact one with the square of the texel's size, and does differ from it.
TEST(MapProjection, TexelCentresConvergeToPatches) {
  const auto radiance = [](Vec3 d, int) { return std::exp(1.5 * d.x + d.y); };
  for (Mapping mapping : {Mapping::cube, Mapping::dual_paraboloid}) {
    double errors[2];
    for (int i = 0; i < 2; ++i) {
      const SphereMap map = sphere_map_of(map_shape(mapping, 16 << i), 1, radiance);
      errors[i] =
          largest_difference(project_map(map, 4).values, project_map(map, 4, TexelRule::centre).values);
    }
    EXPECT_LT(errors[0], 0.06);
    EXPECT_GT(errors[0], 1e-4);
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.6);  // rim texels do not follow the law exactly
  }
}

// Every way sees the same analytic function, within the error of sampling it at texel centres (texel^2 / 24 times its
// second derivatives, at most 3e-4 of the value here).
TEST(MapProjection, AllMappingsAgreeOnAnAnalyticFunction) {
  const Vec3 w{0.3, -0.5, 0.7};
  const auto radiance = [&](Vec3 d, int c) { return 1 + dot(w, d) + c * d.x * d.z; };
  std::vector<double> truth(3 * sh_count(3));
  for (int c = 0; c < 3; ++c) {
    truth[c] = std::sqrt(4 * pi);
    truth[3 * sh_index(1, 1) + c] = std::sqrt(4 * pi / 3) * w.x;
    truth[3 * sh_index(1, -1) + c] = std::sqrt(4 * pi / 3) * w.y;
    truth[3 * sh_index(1, 0) + c] = std::sqrt(4 * pi / 3) * w.z;
    truth[3 * sh_index(2, 1) + c] = c * std::sqrt(4 * pi / 15);
  }
  for (Mapping mapping : all_mappings) {
    const SphereMap map = sphere_map_of(map_shape(mapping, 128), 3, radiance);
    EXPECT_LT(largest_difference(project_map(map, 3, TexelRule::centre).values, truth), 2e-3)
        << mapping_name(mapping);
  }
  for (Mapping mapping : {Mapping::equirectangular, Mapping::cube, Mapping::dual_paraboloid}) {
    const SphereMap map = sphere_map_of(map_shape(mapping, 128), 3, radiance);
    EXPECT_LT(largest_difference(project_map(map, 3).values, truth), 1e-3) << mapping_name(mapping);
  }
}

// Resampling keeps each texel's mean, so low degrees change only by what is moved within a texel: letters have edges,
// and a texel of the discs is up to 1/16 wide.
TEST(MapProjection, AgreesOnAResampledMap) {
  const SphereMap equirect = labelled_map({Mapping::equirectangular, 256, 128});
  const std::vector<double> exact = project_map(equirect, 4).values;
  for (Mapping mapping : {Mapping::cube, Mapping::dual_paraboloid}) {
    const SphereMap map = resample(equirect, map_shape(mapping, 64));
    EXPECT_LT(largest_difference(project_map(map, 4).values, exact), 2e-3 * largest_of(exact));
    EXPECT_LT(largest_difference(project_map(map, 4, TexelRule::centre).values, exact),
              4e-3 * largest_of(exact));
  }
}

TEST(MapProjection, RefusesWhatItCannotDo) {
  EXPECT_THROW(project_cube(Cube(4), -1), Error);
  EXPECT_THROW(project_cube(Cube(4), max_projection_degree + 1), Error);
  EXPECT_THROW(project_cube(Cube(), 2), Error);
  EXPECT_THROW(project_map(make_sphere_map(map_shape(Mapping::octahedral, 8)), 2), Error);
}

}  // namespace
}  // namespace welkin
