#include <welkin/envmap/sky/studio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double degree = std::numbers::pi / 180;

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// A rectangle of cloth that faces the middle of the room: its half extents are tangents of half angles, so its edges
// are great circles, as a flat light's are.
struct SoftBox {
  Vec3 facing, right, up;  // towards its centre, and its axes
  double width, height;    // half extents at distance 1
  double edge;             // half the width of the soft border at distance 1
  Rgb radiance;            // at its brightest
  double hot_spot;         // how much darker the corners are, 0 to 1
};

// Angles in degrees; half_width and half_height are half the angular size.
SoftBox soft_box(double azimuth, double elevation, double half_width, double half_height, double edge,
                 Rgb radiance, double hot_spot) {
  const double a = azimuth * degree, e = elevation * degree;
  const Vec3 facing{std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)};
  const Vec3 right{-std::sin(a), 0, std::cos(a)};
  return {facing,
          right,
          cross(right, facing),
          std::tan(half_width * degree),
          std::tan(half_height * degree),
          edge,
          radiance,
          hot_spot};
}

const std::array<SoftBox, 5>& boxes() {
  static const std::array<SoftBox, 5> all{
      soft_box(-50, 38, 20, 27, 0.05, {24, 22.6, 20.4}, 0.55),  // key
      soft_box(62, 18, 26, 34, 0.12, {3.2, 3.5, 4.0}, 0.35),    // fill
      soft_box(168, 30, 4, 38, 0.025, {34, 35.5, 38}, 0.2),     // rim
      soft_box(-135, 22, 5, 30, 0.03, {12, 12.4, 13}, 0.25),    // second rim
      soft_box(10, 86, 26, 20, 0.08, {7.0, 6.9, 6.7}, 0.4),     // overhead
  };
  return all;
}

// 1 in the middle of the box, falling to 0 over its border, with the lamp's hot spot; 0 behind the viewer.
double box_strength(const SoftBox& box, Vec3 direction) {
  const double ahead = dot(direction, box.facing);
  if (ahead <= 0) return 0;
  const double x = std::abs(dot(direction, box.right)) / ahead, y = std::abs(dot(direction, box.up)) / ahead;
  const double inside = smooth_step(box.width + box.edge, box.width - box.edge, x) *
                        smooth_step(box.height + box.edge, box.height - box.edge, y);
  const double from_centre = x * x / (box.width * box.width) + y * y / (box.height * box.height);
  return inside * (1 - box.hot_spot * std::min(from_centre / 2, 1.0));
}

// Walls that brighten towards the horizon, and a floor at y = -1 with light pooled under the key.
Rgb room(Vec3 direction) {
  const double y = direction.y;
  const Rgb wall = (0.035 + 0.05 * std::exp(-std::abs(y) * 4)) * Rgb{0.95, 1, 1.08};
  if (y >= 0.02) return wall;
  const double down = std::max(-y, 1e-3);
  const double floor_x = direction.x / down - 0.7, floor_z = direction.z / down + 0.8;
  const double pool = 1 / (1 + 0.25 * (floor_x * floor_x + floor_z * floor_z));
  const Rgb floor = (0.08 + 0.75 * pool * pool) * Rgb{1, 0.97, 0.92};
  const double seam = smooth_step(0.02, -0.08, y);  // the wall curves into the floor
  return (1 - seam) * wall + seam * floor;
}

}  // namespace

Rgb studio_radiance(Vec3 direction) {
  Rgb sum = room(direction);
  for (const SoftBox& box : boxes()) sum = sum + box_strength(box, direction) * box.radiance;
  return sum;
}

}  // namespace welkin
