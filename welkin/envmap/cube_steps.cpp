#include <welkin/envmap/cube_steps.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

struct Texel {
  int face, x, y;
};

// The texel across the edge from (face, x, y), one step beyond it in direction (dx, dy).
Texel across(int size, Texel from, int dx, int dy) {
  const CubePoint p = cube_point(cube_ray({from.face, (2 * (from.x + dx) + 1.0) / size - 1, (2 * (from.y + dy) + 1.0) / size - 1}));
  const auto texel = [size](double s) { return std::min(size - 1, static_cast<int>((s + 1) * 0.5 * size)); };
  return {p.face, texel(p.s), texel(p.t)};
}

double step_per_angle(const Cube& cube, Texel a, Texel b) {
  const float* va = cube.at(a.face, a.x, a.y);
  const float* vb = cube.at(b.face, b.x, b.y);
  double step = 0;
  for (int c = 0; c < cube.channels; ++c) step += std::abs(static_cast<double>(va[c]) - static_cast<double>(vb[c]));
  return step / length(cube_texel_direction(cube.size, a.face, a.x, a.y) - cube_texel_direction(cube.size, b.face, b.x, b.y));
}

}  // namespace

double edge_step_ratio(const Cube& cube) {
  const int n = cube.size;
  if (n < 2) return 0;
  double edge = 0, inside = 0;
  // Every border texel of every face: the step outwards over the edge, and the step inwards on the same line. Each
  // edge is met from both of its faces.
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < n; ++i) {
      const struct { Texel texel; int dx, dy; } borders[] = {
          {{face, 0, i}, -1, 0}, {{face, n - 1, i}, 1, 0}, {{face, i, 0}, 0, -1}, {{face, i, n - 1}, 0, 1}};
      for (const auto& b : borders) {
        edge += step_per_angle(cube, b.texel, across(n, b.texel, b.dx, b.dy));
        inside += step_per_angle(cube, b.texel, {face, b.texel.x - b.dx, b.texel.y - b.dy});
      }
    }
  }
  return inside > 0 ? edge / inside : 0;
}

// Euler-Maclaurin for midpoints: integral = h sum f + h^2/24 (f'(b) - f'(a)) + O(h^4), with h f'(a) = -2 f_0 + 3 f_1 - f_2
// from the three samples next to the end.
double cube_energy(const Cube& cube) {
  const int n = cube.size;
  std::vector<double> along(n, 1.0);
  constexpr double corrections[3] = {2.0 / 24, -3.0 / 24, 1.0 / 24};
  for (int i = 0; i < 3 && n >= 4; ++i) {
    along[i] += corrections[i];
    along[n - 1 - i] += corrections[i];
  }
  double energy = 0, area = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const Vec3 ray = cube_ray({face, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1});
        const double weight = along[x] * along[y] * std::pow(dot(ray, ray), -1.5);
        const float* t = cube.at(face, x, y);
        energy += weight * (0.2126 * static_cast<double>(t[0]) + 0.7152 * static_cast<double>(t[1]) +
                            0.0722 * static_cast<double>(t[2]));
        area += weight;
      }
  return energy * 4 * std::numbers::pi / area;
}

}  // namespace welkin
