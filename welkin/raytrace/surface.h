#pragma once
#include <welkin/geometry/frame.h>
#include <welkin/raytrace/ray_scene.h>

namespace welkin {

/// The surface where a ray met it, all in the world frame.
struct Surface {
  Vec3f position;  ///< from the barycentric coordinates, more exact than origin + distance x direction
  float position_error = 0;  ///< bound of its rounding error, metres
  Vec3f geometric_normal;    ///< unit, of the front side (counter-clockwise or outside)
  Frame shading;  ///< interpolated normal and tangent, before any normal map; on the geometric normal's side
  Vec2f texcoords[2];
  int material = 0;
  bool front = true;  ///< whether the ray came from the front side
};

Surface surface_at(const Scene& scene, const Hit& hit, Vec3f ray_direction);

/// Where a ray that leaves the surface in `direction` starts: moved along the geometric normal, to the side of the
/// direction, by a multiple of the position's error, so that it meets neither the surface again nor skips a thin one.
Vec3f leave_surface(const Surface& surface, Vec3f direction);

}  // namespace welkin
