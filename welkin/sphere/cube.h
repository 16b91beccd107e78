#pragma once
#include <cmath>

#include <welkin/sphere/vec3.h>

// Cube maps with the OpenGL/KTX orientation. Face order +X -X +Y -Y +Z -Z; on each face s grows rightwards and t
// grows downwards (from the first stored row), both in [-1, 1]. Texel (x, y) of a face of N x N has its centre at
// s = (2x + 1)/N - 1, t = (2y + 1)/N - 1.

namespace welkin {

/// A point on a cube face.
struct CubePoint {
  int face = 0;
  double s = 0, t = 0;
};

/// The direction of a point on a face, not normalised: its largest component is +-1.
constexpr Vec3 cube_ray(CubePoint point) {
  const double s = point.s, t = point.t;
  switch (point.face) {
    case 0: return {1, -t, -s};
    case 1: return {-1, -t, s};
    case 2: return {s, 1, t};
    case 3: return {s, -1, -t};
    case 4: return {s, -t, 1};
    default: return {-s, -t, -1};
  }
}

/// The unit direction of a point on a face.
inline Vec3 cube_direction(CubePoint point) { return normalized(cube_ray(point)); }

/// The unit direction of the centre of texel (x, y) of `face` in a cube of `size`.
inline Vec3 cube_texel_direction(int size, int face, int x, int y) {
  return cube_direction({face, (2 * x + 1.0) / size - 1, (2 * y + 1.0) / size - 1});
}

/// The face that a direction of any length > 0 pierces, and where. On ties X wins over Y over Z.
inline CubePoint cube_point(Vec3 d) {
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  if (ax >= ay && ax >= az) {
    return d.x > 0 ? CubePoint{0, -d.z / ax, -d.y / ax} : CubePoint{1, d.z / ax, -d.y / ax};
  }
  if (ay >= az) return d.y > 0 ? CubePoint{2, d.x / ay, d.z / ay} : CubePoint{3, d.x / ay, -d.z / ay};
  return d.z > 0 ? CubePoint{4, d.x / az, -d.y / az} : CubePoint{5, -d.x / az, -d.y / az};
}

/// The exact solid angle (sr) of texel (x, y) of any face of a cube of `size`. The integral of
/// 1/(1 + s^2 + t^2)^(3/2) has the antiderivative atan(s t / sqrt(1 + s^2 + t^2)); all texels together give 4 pi.
inline double cube_texel_solid_angle(int size, int x, int y) {
  const auto corner = [](double s, double t) { return std::atan2(s * t, std::sqrt(1 + s * s + t * t)); };
  const double s0 = 2.0 * x / size - 1, s1 = 2.0 * (x + 1) / size - 1;
  const double t0 = 2.0 * y / size - 1, t1 = 2.0 * (y + 1) / size - 1;
  return corner(s1, t1) - corner(s0, t1) - corner(s1, t0) + corner(s0, t0);
}

}  // namespace welkin
