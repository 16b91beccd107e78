#pragma once
#include <array>

#include <welkin/sphere/vec3.h>

namespace welkin {

/// A 3 x 3 matrix by rows; the identity unless said.
struct Mat3 {
  std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
};

constexpr Vec3 operator*(const Mat3& m, Vec3 v) {
  return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
}

constexpr Mat3 transposed(const Mat3& m) {
  const auto& [x, y, z] = m.rows;
  return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}};
}

constexpr bool is_identity(const Mat3& m) {
  const auto& [x, y, z] = m.rows;
  return x.x == 1 && x.y == 0 && x.z == 0 && y.x == 0 && y.y == 1 && y.z == 0 && z.x == 0 && z.y == 0 &&
         z.z == 1;
}

}  // namespace welkin
