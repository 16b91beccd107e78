#include <welkin/sphere/cube_lookup.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

constexpr int max_channels = 4;

// The texel that lies at (x, y) of a face's plane, which may be one step beyond an edge: extending the plane by half a
// texel and piercing the cube with that direction hits the row next to the edge, in the same place along it.
const float* texel_across_edge(const Cube& cube, int face, int x, int y) {
  const int n = cube.size;
  if (x >= 0 && x < n && y >= 0 && y < n) return cube.at(face, x, y);
  const CubePoint p = cube_point(cube_ray({face, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1}));
  const auto texel = [n](double s) { return std::clamp(static_cast<int>((s + 1) * 0.5 * n), 0, n - 1); };
  return cube.at(p.face, texel(p.s), texel(p.t));
}

}  // namespace

void look_up_cube(const Cube& cube, Vec3 direction, float* out) {
  assert(!cube.empty() && cube.channels <= max_channels);
  const CubePoint p = cube_point(direction);
  const double x = (p.s + 1) * 0.5 * cube.size - 0.5, y = (p.t + 1) * 0.5 * cube.size - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  const double weights[4] = {(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
  double sums[max_channels] = {};
  double corner = 0;
  for (int i = 0; i < 4; ++i) {
    const int tx = x0 + (i & 1), ty = y0 + (i >> 1);
    const bool beyond_corner = (tx < 0 || tx >= cube.size) && (ty < 0 || ty >= cube.size);
    if (beyond_corner) {
      corner = weights[i];
      continue;
    }
    const float* texel = texel_across_edge(cube, p.face, tx, ty);
    for (int c = 0; c < cube.channels; ++c) sums[c] += weights[i] * static_cast<double>(texel[c]);
  }
  if (corner > 0) {
    // The fourth texel is the mean of the three, whatever their weights.
    double mean[max_channels] = {};
    for (int i = 0; i < 4; ++i) {
      const int tx = x0 + (i & 1), ty = y0 + (i >> 1);
      if ((tx < 0 || tx >= cube.size) && (ty < 0 || ty >= cube.size)) continue;
      const float* texel = texel_across_edge(cube, p.face, tx, ty);
      for (int c = 0; c < cube.channels; ++c) mean[c] += static_cast<double>(texel[c]) / 3;
    }
    for (int c = 0; c < cube.channels; ++c) sums[c] += corner * mean[c];
  }
  for (int c = 0; c < cube.channels; ++c) out[c] = static_cast<float>(sums[c]);
}

void look_up_cube(const CubeMips& cube, Vec3 direction, double level, float* out) {
  const int last = static_cast<int>(cube.levels.size()) - 1;
  const double clamped = std::clamp(level, 0.0, static_cast<double>(last));
  const int lower = std::min(last, static_cast<int>(clamped)), upper = std::min(last, lower + 1);
  const float blend = static_cast<float>(clamped - lower);
  float below[max_channels], above[max_channels];
  look_up_cube(cube.levels[lower], direction, below);
  look_up_cube(cube.levels[upper], direction, above);
  for (int c = 0; c < cube.channels(); ++c) out[c] = below[c] + blend * (above[c] - below[c]);
}

}  // namespace welkin
