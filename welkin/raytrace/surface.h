#pragma once
#include <welkin/geometry/frame.h>
#include <welkin/raytrace/ray_scene.h>

namespace welkin {

/// The surface where a ray met it, all in the world frame.
struct Surface {
  Vec3f position;  ///< from the barycentric coordinates, more exact than origin + distance x direction
  float position_error =
      0;                   ///< how far from the true surface it and what the tree makes of it may be, metres
  Vec3f geometric_normal;  ///< unit, of the front side (counter-clockwise or outside)
  /// Interpolated normal and tangent, before any normal map; on the geometric normal's side.
  LocalFrame shading;
  float bitangent_sign = 1;  ///< a normal map's green points along bitangent_sign x shading.bitangent
  Vec2f texcoords[2];
  int material = 0;
  bool front = true;  ///< whether the ray came from the front side
};

/// Needs a hit of that scene by that ray.
Surface surface_at(const RayScene& scene, const Hit& hit, const Ray& ray);

/// Asks for the memory that surface_at will read for these hits (bit i of `met` says which there are): the waits of a batch
/// overlap.
void prefetch_surfaces(const RayScene& scene, std::uint32_t met, const Hit* hits);

/// Where a ray that leaves the surface in `direction` starts: moved along the geometric normal, to the side of the
/// direction, by a multiple of the position's error, so that it meets neither the surface again nor skips a thin one.
inline Vec3f leave_surface(const Surface& surface, Vec3f direction) {
  const float side = dot(direction, surface.geometric_normal) < 0 ? -2.0f : 2.0f;
  return surface.position + (side * surface.position_error) * surface.geometric_normal;
}

}  // namespace welkin
