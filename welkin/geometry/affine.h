#pragma once
#include <welkin/geometry/vec3f.h>

namespace welkin {

/// x y z are the images of the unit vectors (the columns of the matrix), origin that of the origin. The identity unless
/// said.
struct Affine {
  Vec3f x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{0, 0, 0};

  Vec3f vector(Vec3f v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3f point(Vec3f p) const { return vector(p) + origin; }
};

/// First b, then a.
constexpr Affine operator*(const Affine& a, const Affine& b) {
  const auto turned = [&a](Vec3f v) { return v.x * a.x + v.y * a.y + v.z * a.z; };
  return {turned(b.x), turned(b.y), turned(b.z), turned(b.origin) + a.origin};
}

/// The volume of the image of the unit cube; negative where left and right are swapped, 0 where nothing can be undone.
constexpr float determinant(const Affine& a) { return dot(cross(a.x, a.y), a.z); }

/// Turns normals with the surface that `a` turns: the cofactor matrix, of the inverse transpose's direction for any
/// determinant but 0, mirrored ones included; not of unit length.
constexpr Vec3f transform_normal(const Affine& a, Vec3f normal) {
  const Vec3f turned = normal.x * cross(a.y, a.z) + normal.y * cross(a.z, a.x) + normal.z * cross(a.x, a.y);
  return determinant(a) < 0 ? -turned : turned;
}

/// The affine map of a glTF node: scale first, then the rotation of the unit quaternion (x, y, z, w), then translation.
Affine make_affine(Vec3f translation, Vec3f axis_part, float real_part, Vec3f scale);

/// Undoes `a`. Throws Error where the determinant is 0 or not finite.
Affine inverse(const Affine& a);

/// A viewer's frame: at `eye`, looking along -z at `target`, y as near to `up` as can be. Throws Error where eye and
/// target are the same or up is along the view.
Affine look_at(Vec3f eye, Vec3f target, Vec3f up);

}  // namespace welkin
