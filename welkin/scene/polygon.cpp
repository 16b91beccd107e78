#include <welkin/scene/polygon.h>

#include <cmath>
#include <cstddef>

namespace welkin {
namespace {

constexpr std::size_t most_ears = 256;  // cutting ears takes time of the third power at worst

struct Point {
  double x, y;
};

double turn(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// The corners in the coordinate plane that Newell's normal is nearest to, so that they run counter-clockwise.
std::vector<Point> flatten(std::span<const Vec3f> corners) {
  double n[3] = {0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3f a = corners[i], b = corners[(i + 1) % corners.size()];
    n[0] += (double{a.y} - b.y) * (double{a.z} + b.z);
    n[1] += (double{a.z} - b.z) * (double{a.x} + b.x);
    n[2] += (double{a.x} - b.x) * (double{a.y} + b.y);
  }
  const double x = std::fabs(n[0]), y = std::fabs(n[1]), z = std::fabs(n[2]);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  std::vector<Point> points;
  for (const Vec3f& c : corners) {
    Point p = axis == 0 ? Point{c.y, c.z} : axis == 1 ? Point{c.z, c.x} : Point{c.x, c.y};
    if (n[axis] < 0) p.x = -p.x;
    points.push_back(p);
  }
  return points;
}

bool is_convex(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
  }
  return true;
}

// Whether the corner `at` of what is left sticks out and no other corner lies in its triangle.
bool is_ear(const std::vector<Point>& p, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const std::uint32_t ia = left[(at + n - 1) % n], ib = left[at], ic = left[(at + 1) % n];
  const Point a = p[ia], b = p[ib], c = p[ic];
  if (!(turn(a, b, c) > 0)) return false;
  for (std::uint32_t i : left) {
    if (i == ia || i == ib || i == ic) continue;
    if (turn(a, b, p[i]) >= 0 && turn(b, c, p[i]) >= 0 && turn(c, a, p[i]) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate(std::span<const Vec3f> corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (corners.size() < 3) return;
  std::vector<std::uint32_t> left(corners.size());
  for (std::uint32_t i = 0; i < left.size(); ++i) left[i] = i;
  if (corners.size() > 3 && corners.size() <= most_ears) {
    const std::vector<Point> points = flatten(corners);
    while (left.size() > 3 && !(left.size() == points.size() && is_convex(points))) {
      std::size_t at = 0;
      while (at < left.size() && !is_ear(points, left, at)) ++at;
      if (at == left.size()) break;  // it crosses itself: the rest as a fan
      const std::size_t n = left.size();
      triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  for (std::size_t i = 2; i < left.size(); ++i) triangles.push_back({left[0], left[i - 1], left[i]});
}

}  // namespace welkin
