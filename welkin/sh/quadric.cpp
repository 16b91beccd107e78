#include <welkin/sh/quadric.h>

#include <welkin/sh/degree2_constants.h>

namespace welkin {

using namespace degree2;

SphereQuadric quadric_from_sh(std::span<const double, 9> f) {
  SphereQuadric q;
  q.c = y00 * f[0];
  q.b = (0.5 * y1) * Vec3{f[3], f[1], f[2]};
  q.xy = 0.5 * y2 * f[4];
  q.yz = 0.5 * y2 * f[5];
  q.xz = 0.5 * y2 * f[7];
  q.zz = 2 * y20 * f[6];
  q.xx = y22 * f[8] - y20 * f[6];
  q.yy = -y22 * f[8] - y20 * f[6];
  return q;
}

void sh_from_quadric(const SphereQuadric& q, std::span<double, 9> f) {
  f[0] = q.c / y00;
  f[1] = 2 / y1 * q.b.y;
  f[2] = 2 / y1 * q.b.z;
  f[3] = 2 / y1 * q.b.x;
  f[4] = 2 / y2 * q.xy;
  f[5] = 2 / y2 * q.yz;
  f[6] = q.zz / (2 * y20);
  f[7] = 2 / y2 * q.xz;
  f[8] = (q.xx - q.yy) / (2 * y22);
}

double evaluate(const SphereQuadric& q, Vec3 n) {
  const double second = q.xx * n.x * n.x + q.yy * n.y * n.y + q.zz * n.z * n.z;
  const double mixed = q.xy * n.x * n.y + q.yz * n.y * n.z + q.xz * n.x * n.z;
  return second + 2 * (mixed + dot(q.b, n)) + q.c;
}

}  // namespace welkin
