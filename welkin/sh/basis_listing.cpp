#include <cmath>
#include <numbers>

#include <welkin/sh/basis.h>

namespace welkin {

std::array<double, 25> sh_basis_degree4(Vec3 d) {
  const double x = d.x, y = d.y, z = d.z, xx = x * x, yy = y * y, zz = z * z;
  static const double pi = std::numbers::pi;
  static const double c00 = std::sqrt(1 / (4 * pi)), c1 = std::sqrt(3 / (4 * pi));
  static const double c2 = std::sqrt(15 / (4 * pi)), c20 = std::sqrt(5 / (16 * pi)),
                      c22 = std::sqrt(15 / (16 * pi));
  static const double c33 = std::sqrt(35 / (32 * pi)), c32 = std::sqrt(105 / (4 * pi)),
                      c31 = std::sqrt(21 / (32 * pi));
  static const double c30 = std::sqrt(7 / (16 * pi)), c32b = std::sqrt(105 / (16 * pi));
  static const double c44 = std::sqrt(315 / (16 * pi)), c43 = std::sqrt(315 / (32 * pi)),
                      c42 = std::sqrt(45 / (16 * pi));
  static const double c41 = std::sqrt(45 / (32 * pi)), c40 = std::sqrt(9 / (256 * pi)),
                      c42b = std::sqrt(45 / (64 * pi));
  static const double c44b = std::sqrt(315 / (256 * pi));
  return {c00,
          c1 * y,
          c1 * z,
          c1 * x,
          c2 * x * y,
          c2 * y * z,
          c20 * (3 * zz - 1),
          c2 * x * z,
          c22 * (xx - yy),
          c33 * y * (3 * xx - yy),
          c32 * x * y * z,
          c31 * y * (5 * zz - 1),
          c30 * z * (5 * zz - 3),
          c31 * x * (5 * zz - 1),
          c32b * z * (xx - yy),
          c33 * x * (xx - 3 * yy),
          c44 * x * y * (xx - yy),
          c43 * y * z * (3 * xx - yy),
          c42 * x * y * (7 * zz - 1),
          c41 * y * z * (7 * zz - 3),
          c40 * (35 * zz * zz - 30 * zz + 3),
          c41 * x * z * (7 * zz - 3),
          c42b * (xx - yy) * (7 * zz - 1),
          c43 * x * z * (xx - 3 * yy),
          c44b * (xx * xx - 6 * xx * yy + yy * yy)};
}

}  // namespace welkin
