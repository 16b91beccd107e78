#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/geometry/fast_angles.h>
#include <welkin/geometry/vec3f.h>

// Maps of the unit square onto other domains that keep areas: uniform (or cosine-weighted) numbers in, points out that
// follow the domain's density. Each has warp_to_X, X_pdf and unwarp_X, the inverse. Directions are about +z.

namespace welkin {

constexpr float pi_f = std::numbers::pi_v<float>;
constexpr float largest_below_1 = 0x1.fffffep-1f;

/// A fraction of a turn as a number of [0, 1).
inline float turns_in_unit(float turns) { return std::min(turns < 0 ? turns + 1 : turns, largest_below_1); }

/// The unit disk, concentric squares to concentric circles: little distortion (Shirley & Chiu 1997).
inline Vec2f warp_to_disk(Vec2f u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  const bool wide = std::fabs(a) > std::fabs(b);
  const float r = wide ? a : b;
  if (r == 0) return {0, 0};
  const float turns = wide ? b / a * 0.125f : 0.25f - a / b * 0.125f;
  return r * cos_sin_turns(turns);
}
/// Per unit area.
inline float disk_pdf() { return 1 / pi_f; }
inline Vec2f unwarp_disk(Vec2f p) {
  const float r = std::sqrt(p.x * p.x + p.y * p.y);
  const bool wide = std::fabs(p.x) > std::fabs(p.y);
  const float along = std::copysign(r, wide ? p.x : p.y);
  const float turns = wide ? atan2_turns(p.y, std::fabs(p.x)) : atan2_turns(p.x, std::fabs(p.y));
  const float across = 8 * turns * r;
  const auto unit = [](float v) { return std::clamp(0.5f * v + 0.5f, 0.0f, largest_below_1); };
  return wide ? Vec2f{unit(along), unit(across)} : Vec2f{unit(across), unit(along)};
}

/// The upper hemisphere, density cos theta / pi (Malley's method).
inline Vec3f warp_to_cosine_hemisphere(Vec2f u) {
  const Vec2f p = warp_to_disk(u);
  return {p.x, p.y, std::sqrt(std::max(0.0f, 1 - p.x * p.x - p.y * p.y))};
}
/// Per steradian; 0 below the horizon.
inline float cosine_hemisphere_pdf(Vec3f direction) { return std::max(0.0f, direction.z) / pi_f; }
inline Vec2f unwarp_cosine_hemisphere(Vec3f direction) { return unwarp_disk({direction.x, direction.y}); }

/// The cone of directions with 1 - cos theta < one_minus_cos (in (0, 2]; given so that narrow cones keep their digits),
/// uniform.
inline Vec3f warp_to_cone(Vec2f u, float one_minus_cos) {
  const float below = u.x * one_minus_cos, r = std::sqrt(below * (2 - below));
  const Vec2f around = cos_sin_turns(u.y);
  return {r * around.x, r * around.y, 1 - below};
}
/// Per steradian, within the cone.
inline float cone_pdf(float one_minus_cos) { return 1 / (2 * pi_f * one_minus_cos); }
inline Vec2f unwarp_cone(Vec3f direction, float one_minus_cos) {
  const float across = direction.x * direction.x + direction.y * direction.y;
  const float below = direction.z > 0 ? across / (1 + direction.z) : 1 - direction.z;
  return {std::min(below / one_minus_cos, largest_below_1),
          turns_in_unit(atan2_turns(direction.y, direction.x))};
}

/// The upper hemisphere and the sphere, uniform.
inline Vec3f warp_to_hemisphere(Vec2f u) { return warp_to_cone(u, 1); }
inline float hemisphere_pdf() { return 1 / (2 * pi_f); }
inline Vec2f unwarp_hemisphere(Vec3f direction) { return unwarp_cone(direction, 1); }
inline Vec3f warp_to_sphere(Vec2f u) { return warp_to_cone(u, 2); }
inline float sphere_pdf() { return 1 / (4 * pi_f); }
inline Vec2f unwarp_sphere(Vec3f direction) { return unwarp_cone(direction, 2); }

/// Barycentric coordinates (b1, b2) of a uniform point of a triangle, p = p0 + b1 (p1 - p0) + b2 (p2 - p0): a square folded
/// along its diagonal, with less distortion than the square root's map (Heitz 2019, "A low-distortion map between
/// triangle and square").
inline Vec2f warp_to_triangle(Vec2f u) {
  return u.y > u.x ? Vec2f{0.5f * u.x, u.y - 0.5f * u.x} : Vec2f{u.x - 0.5f * u.y, 0.5f * u.y};
}
/// Per unit of area.
inline float triangle_pdf(float area) { return 1 / area; }
inline Vec2f unwarp_triangle(Vec2f b) {
  return b.y > b.x ? Vec2f{2 * b.x, b.y + b.x} : Vec2f{b.x + b.y, 2 * b.y};
}

}  // namespace welkin
