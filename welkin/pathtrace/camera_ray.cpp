#include <welkin/pathtrace/camera_ray.h>

#include <welkin/sampling/warp.h>

namespace welkin {

Ray camera_ray(const Camera& camera, PictureSize size, float x, float y) {
  const auto width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  // Both in units of half the picture's height, right and up.
  const float right = (2 * x - width) / height, up = (height - 2 * y) / height;
  const Affine& frame = camera.to_world;
  Ray ray;
  if (camera.orthographic_height) {
    const float half = *camera.orthographic_height / 2;
    ray.origin = frame.origin + (right * half) * frame.x + (up * half) * frame.y;
    ray.direction = normalized(-frame.z);
    return ray;
  }
  const Vec2f half = cos_sin_turns(camera.vertical_field_radians / (4 * pi_f));
  ray.origin = frame.origin;
  ray.direction = normalized((right * half.y) * frame.x + (up * half.y) * frame.y - half.x * frame.z);
  return ray;
}

}  // namespace welkin
