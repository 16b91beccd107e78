#include <welkin/envmap/cube_steps.h>

#include <array>
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
  const CubePoint p = cube_point(
      cube_ray({from.face, (2 * (from.x + dx) + 1.0) / size - 1, (2 * (from.y + dy) + 1.0) / size - 1}));
  const auto texel = [size](double s) { return std::min(size - 1, static_cast<int>((s + 1) * 0.5 * size)); };
  return {p.face, texel(p.s), texel(p.t)};
}

constexpr int outwards[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

bool on_face(int size, int x, int y) { return x >= 0 && x < size && y >= 0 && y < size; }

Vec3 direction_of(const Cube& cube, Texel t) { return cube_texel_direction(cube.size, t.face, t.x, t.y); }

// The step from a to b per unit of the way that it goes along `crossing`, one value a channel. Rows of texels bend where
// they cross an edge, by the same angle to either side, so slopes along the crossing itself are what can be compared.
std::array<double, 4> slope(const Cube& cube, Texel a, Texel b, Vec3 crossing) {
  const float* va = cube.at(a.face, a.x, a.y);
  const float* vb = cube.at(b.face, b.x, b.y);
  const double way = dot(direction_of(cube, b) - direction_of(cube, a), crossing);
  std::array<double, 4> result{};
  for (int c = 0; c < cube.channels; ++c)
    result[c] = (static_cast<double>(vb[c]) - static_cast<double>(va[c])) / way;
  return result;
}

// The texels on a line over an edge: a on this side, b on the other, [0] next to the edge, [1] and [2] further in.
struct Crossing {
  Texel a[3], b[3];
};

Crossing crossing(int size, Texel from, int dx, int dy) {
  Crossing line{};
  const Texel beyond = across(size, from, dx, dy);
  for (int i = 0; i < 3; ++i) line.a[i] = {from.face, from.x - i * dx, from.y - i * dy};
  for (const auto& out : outwards) {
    if (on_face(size, beyond.x + out[0], beyond.y + out[1])) continue;
    const Texel back = across(size, beyond, out[0], out[1]);
    if (back.face != from.face || back.x != from.x || back.y != from.y) continue;
    for (int i = 0; i < 3; ++i) line.b[i] = {beyond.face, beyond.x - i * out[0], beyond.y - i * out[1]};
  }
  return line;
}

// Slopes at +-1 and +-2 steps from the edge give the one at the edge: (4 (g_1 + g_-1) - (g_2 + g_-2)) / 6, exact for
// cubics.
void add_crossing(const Cube& cube, const Crossing& line, double& edge, double& predicted) {
  const Vec3 way = normalized(direction_of(cube, line.b[0]) - direction_of(cube, line.a[0]));
  const auto here = slope(cube, line.a[0], line.b[0], way);
  const auto before = slope(cube, line.a[1], line.a[0], way), after = slope(cube, line.b[0], line.b[1], way);
  const auto earlier = slope(cube, line.a[2], line.a[1], way), later = slope(cube, line.b[1], line.b[2], way);
  for (int c = 0; c < cube.channels; ++c) {
    edge += std::abs(here[c]);
    predicted += std::abs(4 * (before[c] + after[c]) - earlier[c] - later[c]) / 6;
  }
}

}  // namespace

double edge_step_ratio(const Cube& cube) {
  const int n = cube.size;
  if (n < 6) return 0;
  double edge = 0, predicted = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (const auto& out : outwards)
          if (!on_face(n, x + out[0], y + out[1]))
            add_crossing(cube, crossing(n, {face, x, y}, out[0], out[1]), edge, predicted);
  return predicted > 0 ? edge / predicted : 0;
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
