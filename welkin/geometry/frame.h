#pragma once
#include <cmath>

#include <welkin/geometry/vec3f.h>

namespace welkin {

/// A right-handed orthonormal frame: tangent x bitangent = normal. Local x, y, z are along tangent, bitangent, normal.
struct LocalFrame {
  Vec3f tangent{1, 0, 0}, bitangent{0, 1, 0}, normal{0, 0, 1};

  Vec3f to_local(Vec3f world) const {
    return {dot(world, tangent), dot(world, bitangent), dot(world, normal)};
  }
  Vec3f to_world(Vec3f local) const { return local.x * tangent + local.y * bitangent + local.z * normal; }
};

/// A frame about a unit normal, without a preferred tangent and continuous but across normal.z = 0 (Duff et al. 2017,
/// "Building an orthonormal basis, revisited", listing 3).
inline LocalFrame make_frame(Vec3f normal) {
  const float sign = std::copysign(1.0f, normal.z);
  const float a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
  return {{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
          {b, sign + normal.y * normal.y * a, -normal.y},
          normal};
}

/// A frame about a unit normal whose tangent is the part of `tangent` that is perpendicular to it; make_frame(normal)
/// where nothing is left of it or it is not finite.
inline LocalFrame make_frame(Vec3f normal, Vec3f tangent) {
  const Vec3f across = tangent - dot(tangent, normal) * normal;
  const float squared = dot(across, across);
  if (!(squared > 1e-12f * dot(tangent, tangent)) || !(squared < INFINITY)) return make_frame(normal);
  const Vec3f unit = (1 / std::sqrt(squared)) * across;
  return {unit, cross(normal, unit), normal};
}

}  // namespace welkin
