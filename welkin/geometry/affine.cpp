#include <welkin/geometry/affine.h>

#include <cmath>

#include <welkin/error.h>

namespace welkin {

Affine make_affine(Vec3f translation, Vec3f q, float w, Vec3f scale) {
  const Vec3f x{1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y + q.z * w), 2 * (q.x * q.z - q.y * w)};
  const Vec3f y{2 * (q.x * q.y - q.z * w), 1 - 2 * (q.x * q.x + q.z * q.z), 2 * (q.y * q.z + q.x * w)};
  const Vec3f z{2 * (q.x * q.z + q.y * w), 2 * (q.y * q.z - q.x * w), 1 - 2 * (q.x * q.x + q.y * q.y)};
  return {scale.x * x, scale.y * y, scale.z * z, translation};
}

// The rows of the inverse are the cross products of the columns over the determinant (Cramer's rule).
Affine inverse(const Affine& a) {
  const float volume = determinant(a);
  if (volume == 0 || !std::isfinite(volume))
    throw Error("a transform cannot be undone: its determinant is 0");
  const float s = 1 / volume;
  const Vec3f r0 = s * cross(a.y, a.z), r1 = s * cross(a.z, a.x), r2 = s * cross(a.x, a.y);
  Affine result{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
  result.origin = -result.vector(a.origin);
  return result;
}

Affine look_at(Vec3f eye, Vec3f target, Vec3f up) {
  const Vec3f back = eye - target, right = cross(up, back);
  if (!(dot(right, right) > 1e-12f * dot(up, up) * dot(back, back)))
    throw Error("a camera needs a target away from it and an up that is not along its view");
  const Vec3f z = normalized(back), x = normalized(right);
  return {x, cross(z, x), z, eye};
}

}  // namespace welkin
