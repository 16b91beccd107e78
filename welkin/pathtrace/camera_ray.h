#pragma once
#include <welkin/pathtrace/integrator.h>

namespace welkin {

/// The ray through the point (x, y) of the picture, in pixels from the top left corner. Perspective rays begin at the eye,
/// orthographic ones in the plane through it.
Ray camera_ray(const Camera& camera, PictureSize size, float x, float y);

/// Distance of a point from the eye along the view axis, metres.
inline float camera_depth(const Camera& camera, Vec3f point) {
  return -dot(point - camera.to_world.origin, camera.to_world.z);
}

}  // namespace welkin
