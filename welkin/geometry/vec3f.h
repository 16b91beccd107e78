#pragma once
#include <cmath>

// Vectors in single precision, for what is traced: rays, vertices, local directions. Filters and oracles use the double
// Vec3 of welkin/sphere/vec3.h.

namespace welkin {

/// A point of a plane or of the unit square.
struct Vec2f {
  float x = 0, y = 0;
};

constexpr Vec2f operator+(Vec2f a, Vec2f b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2f operator-(Vec2f a, Vec2f b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2f operator*(float s, Vec2f a) { return {s * a.x, s * a.y}; }

/// A point, vector or direction, in the world frame (right-handed, +Y up; metres) or in a local shading frame (z along
/// the normal), as the name or the contract says. Directions are unit length unless said.
struct Vec3f {
  float x = 0, y = 0, z = 0;
};

constexpr Vec3f operator+(Vec3f a, Vec3f b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3f operator-(Vec3f a, Vec3f b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3f operator-(Vec3f a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3f operator*(float s, Vec3f a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr bool operator==(Vec3f a, Vec3f b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
constexpr float dot(Vec3f a, Vec3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3f cross(Vec3f a, Vec3f b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3f a) { return std::sqrt(dot(a, a)); }
/// Needs length > 0.
inline Vec3f normalized(Vec3f a) { return (1 / length(a)) * a; }
/// `direction` mirrored about the unit vector `axis`: 2 (axis . direction) axis - direction.
constexpr Vec3f reflected(Vec3f direction, Vec3f axis) { return 2 * dot(direction, axis) * axis - direction; }

}  // namespace welkin
