#pragma once
#include <welkin/pathtrace/integrator.h>

namespace welkin {

/// A camera made ready for one size of picture.
class CameraRays {
 public:
  CameraRays(const Camera& camera, PictureSize size);

  /// The ray through the point (x, y) of the picture, in pixels from the top left corner. Perspective rays begin at the
  /// eye, orthographic ones in the plane through it.
  Ray ray(float x, float y) const {
    const Vec3f to_point = corner_ + x * right_ + y * down_;
    return parallel_ ? Ray{to_point, 0, forward_, 1e30f} : Ray{eye_, 0, normalized(to_point), 1e30f};
  }

 private:
  Vec3f eye_, forward_;
  Vec3f corner_, right_, down_;  ///< perspective: directions; orthographic: the corner is a point
  bool parallel_ = false;
};

/// Distance of a point from the eye along the view axis, metres.
inline float camera_depth(const Camera& camera, Vec3f point) {
  return -dot(point - camera.to_world.origin, camera.to_world.z);
}

}  // namespace welkin
