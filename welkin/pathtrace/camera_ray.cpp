#include <welkin/pathtrace/camera_ray.h>

#include <cmath>

namespace welkin {

CameraRays::CameraRays(const Camera& camera, PictureSize size)
    : eye_(camera.to_world.origin), forward_(normalized(-camera.to_world.z)) {
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  parallel_ = camera.orthographic_height.has_value();
  const float half = parallel_ ? *camera.orthographic_height / 2 : std::tan(camera.vertical_field_radians / 2);
  const float pixel = 2 * half / height;
  right_ = pixel * camera.to_world.x;
  down_ = -pixel * camera.to_world.y;
  corner_ = -(width / 2) * right_ - (height / 2) * down_ + (parallel_ ? eye_ : forward_);
}

}  // namespace welkin
