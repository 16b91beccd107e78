// Exact solid angles of texels, one closed form for each mapping.
//
// Disc maps. With r^2 = a^2 + b^2, a patch of the stereographic disc has solid angle 4 / (1 + r^2)^2 da db and a
// patch of the mirror ball's disc 4 da db. Both are radially symmetric, so by Green's theorem the integral over a
// region is the integral of g(r) dphi along its boundary, where g(r) = integral of density * r from 0 to r:
//   stereographic  g = 2 r^2 / (1 + r^2),  mirror ball  g = 2 r^2.
// As r^2 dphi = a db - b da, an edge at constant b contributes
//   stereographic  -2 b integral of da / (1 + b^2 + a^2) = -2 b / c [atan(a / c)],  c = sqrt(1 + b^2)
//   mirror ball    -2 b (a1 - a0)
// and an arc of the rim contributes its angle times g(1) = 1 or 2. Every term has the size of the texel's edge, so
// only one factor of the texel's width is lost to cancellation.
//
// Octahedral. Each of the eight faces is a gnomonic projection: straight lines are great circles, and a texel cut
// along the folds is a set of spherical polygons.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/sphere/cube.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/mapping.h>

namespace welkin {
namespace {

struct Box {
  double a0, a1, b0, b1;
};

struct Segment {
  double a0, b0, a1, b1;
};

// The part of a horizontal or vertical edge inside the unit disc; false where there is none.
bool clip_to_disc(Segment& edge) {
  const bool horizontal = edge.b0 == edge.b1;
  const double fixed = horizontal ? edge.b0 : edge.a0;
  if (std::abs(fixed) >= 1) return false;
  const double reach = std::sqrt((1 - fixed) * (1 + fixed));
  double& from = horizontal ? edge.a0 : edge.b0;
  double& to = horizontal ? edge.a1 : edge.b1;
  if (std::max(from, to) <= -reach || std::min(from, to) >= reach) return false;
  from = std::clamp(from, -reach, reach);
  to = std::clamp(to, -reach, reach);
  return true;
}

// The boundary integral of g dphi along an axis-parallel segment. A vertical one is a horizontal one turned by a
// quarter: (a, b) -> (b, -a).
double segment_flux(Segment s, bool stereographic) {
  const bool horizontal = s.b0 == s.b1;
  const double fixed = horizontal ? s.b0 : -s.a0;
  const double from = horizontal ? s.a0 : s.b0, to = horizontal ? s.a1 : s.b1;
  if (!stereographic) return -2 * fixed * (to - from);
  const double c2 = 1 + fixed * fixed, c = std::sqrt(c2);
  return -2 * fixed / c * std::atan2((to - from) * c, c2 + from * to);
}

// The solid angle of the part of a box inside the unit disc.
double disc_box(Box box, bool stereographic) {
  const std::array<Segment, 4> edges{{{box.a0, box.b0, box.a1, box.b0},
                                      {box.a1, box.b0, box.a1, box.b1},
                                      {box.a1, box.b1, box.a0, box.b1},
                                      {box.a0, box.b1, box.a0, box.b0}}};
  std::array<Segment, 4> inside{};
  std::size_t count = 0;
  for (Segment edge : edges) {
    if (clip_to_disc(edge)) inside[count++] = edge;
  }
  const double rim = stereographic ? 1 : 2;
  if (count == 0)
    return box.a0 < 0 && box.a1 > 0 && box.b0 < 0 && box.b1 > 0 ? rim * 2 * std::numbers::pi : 0;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Segment s = inside[i], next = inside[(i + 1) % count];
    sum += segment_flux(s, stereographic);
    if (s.a1 == next.a0 && s.b1 == next.b0) continue;
    sum += rim * std::atan2(s.a1 * next.b0 - s.b1 * next.a0, s.a1 * next.a0 + s.b1 * next.b0);
  }
  return std::max(sum, 0.0);
}

double disc_texel(int size, int x, int y, bool stereographic) {
  const double n = size;
  return disc_box({2 * x / n - 1, 2 * (x + 1) / n - 1, 2 * y / n - 1, 2 * (y + 1) / n - 1}, stereographic);
}

// The solid angle of a triangle (van Oosterom and Strackee 1983). The triple product is taken of differences, so
// that small triangles keep their digits.
double triangle_solid_angle(Vec3 a, Vec3 b, Vec3 c) {
  const double triple = dot(a, cross(b - a, c - a));
  return 2 * std::atan2(std::abs(triple), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

struct Uv2 {
  double u, v;
};
using Polygon = std::vector<Uv2>;

// The part of a convex polygon where p u + q v + r >= 0 (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& polygon, double p, double q, double r) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Uv2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
    const double d0 = p * from.u + q * from.v + r, d1 = p * to.u + q * to.v + r;
    if (d0 >= 0) kept.push_back(from);
    if ((d0 > 0 && d1 < 0) || (d0 < 0 && d1 > 0)) {
      const double t = d0 / (d0 - d1);
      kept.push_back({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)});
    }
  }
  return kept;
}

// One face of the octahedron: lower faces unfold to the corners by (u, v) -> (1 - v, 1 - u) in absolute values.
double face_polygon(const Polygon& polygon, bool upper) {
  if (polygon.size() < 3) return 0;
  const auto direction = [&](Uv2 p) {
    const double u = std::abs(p.u), v = std::abs(p.v);
    return upper ? normalized({u, 1 - u - v, v}) : normalized({1 - v, u + v - 1, 1 - u});
  };
  double sum = 0;
  const Vec3 first = direction(polygon[0]);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += triangle_solid_angle(first, direction(polygon[i - 1]), direction(polygon[i]));
  }
  return sum;
}

double octahedral_box(Box box) {
  const Polygon corners{{box.a0, box.b0}, {box.a1, box.b0}, {box.a1, box.b1}, {box.a0, box.b1}};
  double sum = 0;
  for (double su : {-1.0, 1.0}) {
    if (su * box.a0 <= 0 && su * box.a1 <= 0) continue;
    for (double sv : {-1.0, 1.0}) {
      if (sv * box.b0 <= 0 && sv * box.b1 <= 0) continue;
      const Polygon quadrant = clip(clip(corners, su, 0, 0), 0, sv, 0);
      sum +=
          face_polygon(clip(quadrant, -su, -sv, 1), true) + face_polygon(clip(quadrant, su, sv, -1), false);
    }
  }
  return sum;
}

// cube_texel_solid_angle for a row, with each of its corners evaluated once for the two texels that meet there, and for
// their mirror images in the right half.
void cube_row(int size, int y, std::vector<double>& out) {
  const auto corner = [](double s, double t) { return std::atan2(s * t, std::sqrt(1 + s * s + t * t)); };
  const double t0 = 2.0 * y / size - 1, t1 = 2.0 * (y + 1) / size - 1;
  double before = corner(-1, t1) - corner(-1, t0);
  for (int x = 0; x < (size + 1) / 2; ++x) {
    const double s = 2.0 * (x + 1) / size - 1;
    const double after = corner(s, t1) - corner(s, t0);
    out[static_cast<std::size_t>(x)] = out[static_cast<std::size_t>(size - 1 - x)] = after - before;
    before = after;
  }
}

}  // namespace

void map_row_solid_angles(MapShape shape, int y, std::vector<double>& out) {
  if (shape.mapping == Mapping::equirectangular) {
    out.assign(static_cast<std::size_t>(shape.width), map_texel_solid_angle(shape, 0, y));
    return;
  }
  out.resize(static_cast<std::size_t>(shape.width));
  if (shape.mapping == Mapping::cube) return cube_row(shape.width, y % shape.width, out);
  for (int x = 0; x < shape.width; ++x) out[static_cast<std::size_t>(x)] = map_texel_solid_angle(shape, x, y);
}

double map_texel_solid_angle(MapShape shape, int x, int y) {
  const int size = shape.height;
  switch (shape.mapping) {
    case Mapping::equirectangular: return equirect_texel_solid_angle(shape.width, shape.height, y);
    case Mapping::cube: return cube_texel_solid_angle(shape.width, x, y % shape.width);
    case Mapping::dual_paraboloid: return disc_texel(size, x % size, y, true);
    case Mapping::mirror_ball: return disc_texel(size, x, y, false);
    default: {
      const double n = size;
      return octahedral_box({2 * x / n - 1, 2 * (x + 1) / n - 1, 2 * y / n - 1, 2 * (y + 1) / n - 1});
    }
  }
}

}  // namespace welkin
