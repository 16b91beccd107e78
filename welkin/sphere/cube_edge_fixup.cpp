#include <welkin/sphere/cube_edge_fixup.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sphere/cube.h>

namespace welkin {
namespace {

constexpr int max_channels = 4;
using Texel4 = std::array<double, max_channels>;

struct Place {
  int face, x, y;
};

bool operator<(const Place& a, const Place& b) {
  return std::array{a.face, a.y, a.x} < std::array{b.face, b.y, b.x};
}

bool on_face(int size, int x, int y) { return x >= 0 && x < size && y >= 0 && y < size; }

double texel_coordinate(double s, int size) { return (s + 1) * 0.5 * size - 0.5; }

// The centre of (x, y) on a face's plane, which may lie beyond its edges.
CubePoint plane_point(int size, int face, int x, int y) {
  return {face, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1};
}

// The texel that touches (face, x, y) across the edge in direction (dx, dy).
Place across(int size, Place from, int dx, int dy) {
  const CubePoint p = cube_point(cube_ray(plane_point(size, from.face, from.x + dx, from.y + dy)));
  const auto texel = [size](double s) {
    return std::clamp(static_cast<int>((s + 1) * 0.5 * size), 0, size - 1);
  };
  return {p.face, texel(p.s), texel(p.t)};
}

void add(Texel4& sum, double weight, const float* texel, int channels) {
  for (int c = 0; c < channels; ++c) sum[c] += weight * static_cast<double>(texel[c]);
}

// Catmull & Rom 1974 at fraction f between the second and the third of four samples.
std::array<double, 4> cubic_weights(double f) {
  return {f * (-0.5 + f * (1 - 0.5 * f)), 1 + f * f * (-2.5 + 1.5 * f), f * (0.5 + f * (2 - 1.5 * f)),
          f * f * (-0.5 + 0.5 * f)};
}

// The cubic at fractions (fx, fy) behind the texel at (1, 1) of 4 x 4, within the range of the four nearest: next to a
// lamp a cubic alone would go below 0.
template <class At>
double limited_cubic(double fx, double fy, At&& at) {
  const auto wx = cubic_weights(fx), wy = cubic_weights(fy);
  double sum = 0, low = at(1, 1), high = low;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const double v = at(i, j);
      sum += wx[i] * wy[j] * v;
      const bool near = (i == 1 || i == 2) && (j == 1 || j == 2);
      if (near) low = std::min(low, v), high = std::max(high, v);
    }
  return std::clamp(sum, low, high);
}

// The value beyond one edge of a face's plane: that of the neighbour in its direction, which lies next to its texel
// centres across the edge, and between them along it. Taps beyond the neighbour repeat its last texel.
Texel4 value_beyond_edge(const Cube& cube, int face, int x, int y) {
  const CubePoint p = cube_point(cube_ray(plane_point(cube.size, face, x, y)));
  const double px = texel_coordinate(p.s, cube.size), py = texel_coordinate(p.t, cube.size);
  const int x0 = static_cast<int>(std::floor(px)), y0 = static_cast<int>(std::floor(py));
  const auto clamped = [&](int i) { return std::clamp(i, 0, cube.size - 1); };
  Texel4 value{};
  for (int c = 0; c < cube.channels; ++c)
    value[c] = limited_cubic(px - x0, py - y0, [&](int i, int j) {
      return static_cast<double>(cube.at(p.face, clamped(x0 + i - 1), clamped(y0 + j - 1))[c]);
    });
  return value;
}

// A face with two more texels on every side. Beyond a corner, where no face lies, the plane through three neighbours.
class PaddedFace {
 public:
  PaddedFace(const Cube& cube, int face)
      : size_(cube.size), side_(cube.size + 4), values_(static_cast<std::size_t>(side_) * side_) {
    for (int y = -2; y < size_ + 2; ++y)
      for (int x = -2; x < size_ + 2; ++x)
        if (on_face(size_, x, y))
          add(at(x, y), 1, cube.at(face, x, y), cube.channels);
        else if (!beyond_corner(x, y))
          at(x, y) = value_beyond_edge(cube, face, x, y);
    for (int y : {-2, -1, size_, size_ + 1})
      for (int x : {-2, -1, size_, size_ + 1}) at(x, y) = extended(x, y, cube.channels);
  }

  // The cubic at texel coordinates in [-0.5, size - 0.5].
  void sample(double x, double y, int channels, float* out) {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    for (int c = 0; c < channels; ++c)
      out[c] = static_cast<float>(
          limited_cubic(x - x0, y - y0, [&](int i, int j) { return at(x0 + i - 1, y0 + j - 1)[c]; }));
  }

 private:
  bool beyond_corner(int x, int y) const { return (x < 0 || x >= size_) && (y < 0 || y >= size_); }
  Texel4 extended(int x, int y, int channels) {
    const int inner_x = std::clamp(x, 0, size_ - 1), inner_y = std::clamp(y, 0, size_ - 1);
    Texel4 value{};
    for (int c = 0; c < channels; ++c)
      value[c] = at(x, inner_y)[c] + at(inner_x, y)[c] - at(inner_x, inner_y)[c];
    return value;
  }
  Texel4& at(int x, int y) {
    const int column = std::clamp(x + 2, 0, side_ - 1), row = std::clamp(y + 2, 0, side_ - 1);
    return values_[static_cast<std::size_t>(row) * side_ + column];
  }

  int size_, side_;
  std::vector<Texel4> values_;
};

// Texel x of the warped face is at s = (2x - (N - 1))/(N - 1).
void warp_face(const Cube& cube, int face, Cube& out) {
  PaddedFace padded(cube, face);
  const int n = cube.size, last = n - 1;
  const auto coordinate = [&](int x) {
    return texel_coordinate(static_cast<double>(2 * x - last) / last, n);
  };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      padded.sample(coordinate(x), coordinate(y), cube.channels, out.at(face, x, y));
}

constexpr int outwards[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};

// The mean over the texels that touch an edge texel and itself, summed in an order that does not depend on which of
// them asks, so that all get the same bits.
Texel4 mean_across(const Cube& cube, Place place) {
  std::array<Place, 3> group{place, place, place};
  std::size_t count = 1;
  for (const auto& out : outwards)
    if (!on_face(cube.size, place.x + out[0], place.y + out[1]))
      group[count++] = across(cube.size, place, out[0], out[1]);
  for (const auto& [i, j] :
       {std::pair{0, 1}, {1, 2}, {0, 1}})  // in order; those not in use are behind already
    if (static_cast<std::size_t>(j) < count && group[j] < group[i]) std::swap(group[i], group[j]);
  Texel4 sum{};
  for (std::size_t i = 0; i < count; ++i)
    add(sum, 1, cube.at(group[i].face, group[i].x, group[i].y), cube.channels);
  for (double& v : sum) v /= static_cast<double>(count);
  return sum;
}

// Falls from 1 at the edge to 0 at `width` texels, flat at both ends.
double falloff(int distance, int width) {
  if (distance >= width) return 0;
  const double t = static_cast<double>(distance) / width;
  return 1 - t * t * (3 - 2 * t);
}

// What a texel's distance from the two sides of one axis means: the nearer side and the weight of its change.
struct Side {
  int edge;
  double weight;
};

Side nearer_side(int x, int n, int width) {
  const bool low = 2 * x < n;
  return {low ? 0 : n - 1, falloff(low ? x : n - 1 - x, width)};
}

// The changes of the edge texels, carried inwards as a Coons patch: along x, plus along y, less what both share.
void average_face(const Cube& cube, int face, int width, Cube& out) {
  const int n = cube.size;
  const auto change = [&](int x, int y) {
    Texel4 mean = mean_across(cube, {face, x, y});
    add(mean, -1, cube.at(face, x, y), cube.channels);
    return mean;
  };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const Side sx = nearer_side(x, n, width), sy = nearer_side(y, n, width);
      float* to = out.at(face, x, y);
      if (x == sx.edge || y == sy.edge) {
        const Texel4 mean = mean_across(cube, {face, x, y});
        for (int c = 0; c < cube.channels; ++c) to[c] = static_cast<float>(mean[c]);
        continue;
      }
      if (sx.weight == 0 && sy.weight == 0) continue;
      const Texel4 dx = change(sx.edge, y), dy = change(x, sy.edge), both = change(sx.edge, sy.edge);
      for (int c = 0; c < cube.channels; ++c) {
        const double value = static_cast<double>(to[c]) + sx.weight * dx[c] + sy.weight * dy[c] -
                             sx.weight * sy.weight * both[c];
        to[c] = static_cast<float>(to[c] >= 0 ? std::max(0.0, value) : value);
      }
    }
}

// Three texels lie evenly about a corner of the cube: their mean is good to second order there.
void put_corners(const Cube& cube, int face, Cube& out) {
  for (int y : {0, cube.size - 1})
    for (int x : {0, cube.size - 1}) {
      const Texel4 mean = mean_across(cube, {face, x, y});
      for (int c = 0; c < cube.channels; ++c) out.at(face, x, y)[c] = static_cast<float>(mean[c]);
    }
}

Cube mean_of_faces(const Cube& cube) {
  Cube out(1, cube.channels);
  for (int c = 0; c < cube.channels; ++c) {
    double sum = 0;
    for (int face = 0; face < 6; ++face) sum += static_cast<double>(cube.at(face, 0, 0)[c]);
    for (int face = 0; face < 6; ++face) out.at(face, 0, 0)[c] = static_cast<float>(sum / 6);
  }
  return out;
}

template <class Work>
void each_face(Work&& work) {
  parallel_for(6, 1, [&](std::size_t face, std::size_t) { work(static_cast<int>(face)); });
}

// A face's coordinates of a direction that may pierce another.
CubePoint point_on(int face, Vec3 d) {
  const Vec3 centre = cube_ray({face, 0, 0});
  const Vec3 along = cube_ray({face, 1, 0}) - centre, down = cube_ray({face, 0, 1}) - centre;
  const double depth = dot(d, centre);
  return {face, dot(d, along) / depth, dot(d, down) / depth};
}

void look_up_on(const Cube& cube, CubePoint p, EdgeFixup fixup, float* out) {
  const int n = cube.size;
  const double scale = fixup == EdgeFixup::warp ? (n - 1.0) / n : 1.0;
  const auto clamped = [n](double x) { return std::clamp(x, 0.0, n - 1.0); };
  const double x = clamped(texel_coordinate(scale * p.s, n)), y = clamped(texel_coordinate(scale * p.t, n));
  const int x0 = std::min(static_cast<int>(x), std::max(0, n - 2));
  const int y0 = std::min(static_cast<int>(y), std::max(0, n - 2));
  const int x1 = std::min(x0 + 1, n - 1), y1 = std::min(y0 + 1, n - 1);
  const double fx = x - x0, fy = y - y0;
  Texel4 sum{};
  add(sum, (1 - fx) * (1 - fy), cube.at(p.face, x0, y0), cube.channels);
  add(sum, fx * (1 - fy), cube.at(p.face, x1, y0), cube.channels);
  add(sum, (1 - fx) * fy, cube.at(p.face, x0, y1), cube.channels);
  add(sum, fx * fy, cube.at(p.face, x1, y1), cube.channels);
  for (int c = 0; c < cube.channels; ++c) out[c] = static_cast<float>(sum[c]);
}

}  // namespace

std::string_view edge_fixup_name(EdgeFixup fixup) {
  return fixup == EdgeFixup::warp ? "warp" : fixup == EdgeFixup::average ? "average" : "none";
}

std::optional<EdgeFixup> edge_fixup_from_name(std::string_view name) {
  for (const EdgeFixup fixup : {EdgeFixup::none, EdgeFixup::warp, EdgeFixup::average})
    if (name == edge_fixup_name(fixup)) return fixup;
  return std::nullopt;
}

Cube fix_edges(const Cube& cube, EdgeFixup fixup) {
  assert(cube.channels <= max_channels);
  if (fixup == EdgeFixup::none || cube.empty()) return cube;
  if (cube.size == 1) return mean_of_faces(cube);
  Cube out = cube;
  if (fixup == EdgeFixup::average) {
    const int width = std::clamp(cube.size / 2, 1, edge_falloff);
    each_face([&](int face) { average_face(cube, face, width, out); });
    return out;
  }
  each_face([&](int face) { warp_face(cube, face, out); });
  Cube joined = out;
  each_face([&](int face) {
    average_face(out, face, 1, joined);
    put_corners(cube, face, joined);
  });
  return joined;
}

CubeMips fix_edges(const CubeMips& cube, EdgeFixup fixup) {
  CubeMips out;
  for (const Cube& level : cube.levels) out.levels.push_back(fix_edges(level, fixup));
  return out;
}

void look_up_cube_face(const Cube& cube, Vec3 direction, EdgeFixup fixup, float* out) {
  assert(!cube.empty() && cube.channels <= max_channels);
  look_up_on(cube, cube_point(direction), fixup, out);
}

double face_edge_step(const Cube& cube, EdgeFixup fixup) {
  assert(!cube.empty() && cube.channels <= max_channels);
  double step = 0, norm = 0;
  const int points = 4 * cube.size;
  for (int face = 0; face < 6; ++face)
    for (const auto& out : outwards)
      for (int i = 0; i < points; ++i) {
        const double along = (2 * i + 1.0) / points - 1;
        const CubePoint here{face, out[0] != 0 ? out[0] : along, out[1] != 0 ? out[1] : along};
        const CubePoint beyond = {face, here.s * (out[0] != 0 ? 1.5 : 1), here.t * (out[1] != 0 ? 1.5 : 1)};
        const int neighbour = cube_point(cube_ray(beyond)).face;
        float a[max_channels], b[max_channels];
        look_up_on(cube, here, fixup, a);
        look_up_on(cube, point_on(neighbour, cube_ray(here)), fixup, b);
        for (int c = 0; c < cube.channels; ++c) {
          const double difference = static_cast<double>(a[c]) - b[c],
                       mean = 0.5 * (static_cast<double>(a[c]) + b[c]);
          step += difference * difference;
          norm += mean * mean;
        }
      }
  return norm > 0 ? std::sqrt(step / norm) : 0;
}

}  // namespace welkin
