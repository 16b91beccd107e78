#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/equirect_neighbours.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

SphereMap noise(MapShape shape, int channels, unsigned seed) {
  SphereMap map = make_sphere_map(shape, channels);
  std::mt19937 random(seed);
  for (float& value : map.image.pixels) value = static_cast<float>(random() % 1000) / 500;
  return map;
}

// The map turned by `columns` columns to the right.
SphereMap rolled(const SphereMap& map, int columns) {
  SphereMap result = map;
  const int width = map.image.width, channels = map.image.channels;
  for (int y = 0; y < map.image.height; ++y) {
    for (int x = 0; x < width; ++x)
      std::copy_n(map.image.at(x, y), channels, result.image.at((x + columns) % width, y));
  }
  return result;
}

Mat3 turn_about_y(double angle) {  // phi -> phi + angle
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 matrix;
  matrix.rows = {Vec3{c, 0, -s}, Vec3{0, 1, 0}, Vec3{s, 0, c}};
  return matrix;
}

struct Difference {
  double at_poles = 0, elsewhere = 0;
};

Difference largest_difference(const SphereMap& a, const SphereMap& b) {
  const int n = a.image.width;
  Difference worst;
  for (int y = 0; y < a.image.height; ++y) {
    for (int x = 0; x < n; ++x) {
      const int face = y / n, s = 2 * x + 1 - n, t = 2 * (y % n) + 1 - n;
      double& where = (face == 2 || face == 3) && std::max(std::abs(s), std::abs(t)) <= 1 ? worst.at_poles
                                                                                          : worst.elsewhere;
      for (int c = 0; c < a.image.channels; ++c)
        where = std::max(where, static_cast<double>(std::abs(a.image.at(x, y)[c] - b.image.at(x, y)[c])));
    }
  }
  return worst;
}

// A source turned by whole columns and turned back on the way gives the same cube, but with an orientation resample
// goes texel by texel, without mirrors. Values are below 2: rounding to float is 1.2e-7, and twice that where the two
// fall on different sides. The texels around the poles, where the seam ends, are quartered up to the last depth, and the pieces that are
// left there fall to one column or the next by rounding: a few thousandths of the values.
TEST(CubeMirrors, GiveWhatTexelByTexelGives) {
  struct Case {
    int width, height, size, channels;
  };
  for (const Case& k :
       {Case{64, 32, 16, 3}, Case{64, 32, 33, 1}, Case{100, 41, 17, 2}, Case{8, 4, 16, 4}, Case{4, 3, 7, 3},
        Case{256, 128, 128, 3}, Case{512, 256, 20, 3}, Case{36, 19, 1, 3}, Case{4, 1, 2, 1}}) {
    const SphereMap source = noise({Mapping::equirectangular, k.width, k.height}, k.channels, 7);
    const MapShape target = map_shape(Mapping::cube, k.size);
    for (int columns : {1, k.width / 4 + 1}) {
      ResampleOptions options;
      options.keep_energy = false;
      const SphereMap mirrored = resample(source, target, options);
      options.orientation = turn_about_y(-2 * std::numbers::pi * columns / k.width);
      const Difference difference =
          largest_difference(mirrored, resample(rolled(source, columns), target, options));
      EXPECT_LT(difference.elsewhere, 3e-7) << k.width << "x" << k.height << " to " << k.size;
      EXPECT_LT(difference.at_poles, 6e-3) << k.width << "x" << k.height << " to " << k.size;
    }
  }
}

TEST(CubeMirrors, GiveTheSameBytesOnAnyNumberOfThreads) {
  const SphereMap source = noise({Mapping::equirectangular, 128, 64}, 3, 3);
  for (int size : {31, 64}) {
    set_thread_count(1);
    const SphereMap one = resample(source, map_shape(Mapping::cube, size));
    set_thread_count(4);
    const SphereMap four = resample(source, map_shape(Mapping::cube, size));
    set_thread_count(0);
    EXPECT_EQ(one.image.pixels, four.image.pixels);
  }
}

// Against a look at every texel. 2 - 2 cos of a small angle has lost digits: 4e-16 / radius^2 of a weight's largest
// value, at most 1e-11 here; the sum of squares of differences finds weights left out, doubled or misplaced.
TEST(EquirectNeighbours, AreThoseWithinTheRadius) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (MapShape shape :
       {MapShape{Mapping::equirectangular, 40, 20}, MapShape{Mapping::equirectangular, 7, 30},
        MapShape{Mapping::equirectangular, 1, 1}, MapShape{Mapping::equirectangular, 128, 5}}) {
    const EquirectNeighbours neighbours(shape);
    std::vector<Vec3> directions{{0, 1, 0}, {0, -1, 0}, {-1, 0, 0}, {1, 0, 0}, normalized({1e-9, 1, -1e-9})};
    for (int i = 0; i < 40; ++i)
      directions.push_back(normalized({uniform(random), uniform(random), uniform(random)}));
    for (const Vec3& d : directions) {
      for (double radius : {0.01, 0.3, 1.2, 2.5}) {
        std::vector<TexelWeight> list;
        const double total = neighbours.append(d, radius, list);
        std::vector<double> weights(static_cast<std::size_t>(shape.width) * shape.height);
        for (const TexelWeight& w : list)
          weights[static_cast<std::size_t>(w.y * shape.width + w.x)] += w.weight;
        double expected_total = 0, worst = 0;
        for (int y = 0; y < shape.height; ++y) {
          for (int x = 0; x < shape.width; ++x) {
            const double chord = length(map_texel_direction(shape, x, y) - d) / radius;
            const double expected =
                std::pow(std::max(0.0, 1 - chord * chord), 3) * map_texel_solid_angle(shape, x, y);
            expected_total += expected;
            worst =
                std::max(worst, std::abs(weights[static_cast<std::size_t>(y * shape.width + x)] - expected));
          }
        }
        EXPECT_LT(worst, 1e-10);
        EXPECT_NEAR(total, expected_total, 1e-9);
      }
    }
  }
}

}  // namespace
}  // namespace welkin
