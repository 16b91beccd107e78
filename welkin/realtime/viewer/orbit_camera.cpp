#include <welkin/realtime/viewer/orbit_camera.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float widest_field_radians = 2.6f;

void set_bounds(OrbitCamera& orbit, const Bounds& bounds) {
  orbit.home = 0.5f * (bounds.low + bounds.high);
  orbit.radius = std::max(0.5f * length(bounds.high - bounds.low), 1e-6f);
}

// Places the eye of `orbit` at the camera's, its centre on the camera's axis.
void adopt(OrbitCamera& orbit, const Camera& camera) {
  const Vec3f forward = -camera.to_world.z, eye = camera.to_world.origin;
  orbit.distance = std::max(dot(orbit.home - eye, forward), 0.05f * orbit.radius);
  orbit.centre = eye + orbit.distance * forward;
  orbit.azimuth_radians = std::atan2(-forward.x, -forward.z);
  orbit.elevation_radians = std::clamp(std::asin(std::clamp(-forward.y, -1.0f, 1.0f)), -max_elevation_radians,
                                       max_elevation_radians);
  orbit.vertical_field_radians = camera.vertical_field_radians;
  orbit.orthographic_height = camera.orthographic_height;
  orbit.width_over_height = camera.width_over_height;
  orbit.untouched = camera;
}

Vec3f to_eye(const OrbitCamera& c) {
  const float across = std::cos(c.elevation_radians);
  return {across * std::sin(c.azimuth_radians), std::sin(c.elevation_radians),
          across * std::cos(c.azimuth_radians)};
}

// Metres of the plane through the centre that the picture's height shows.
float height_at_centre(const OrbitCamera& c) {
  return c.orthographic_height ? *c.orthographic_height
                               : 2 * c.distance * std::tan(0.5f * c.vertical_field_radians);
}

// What was framed for wider pictures: the horizontal field stays.
void widen(Camera& camera, float factor) {
  if (camera.orthographic_height) {
    *camera.orthographic_height *= factor;
    return;
  }
  const float half = std::atan(factor * std::tan(0.5f * camera.vertical_field_radians));
  camera.vertical_field_radians = std::min(2 * half, widest_field_radians);
}

}  // namespace

OrbitCamera frame_bounds(const Bounds& bounds) {
  OrbitCamera orbit;
  set_bounds(orbit, bounds);
  Camera camera = default_camera(bounds, 1);
  camera.width_over_height = 1;
  adopt(orbit, camera);
  return orbit;
}

OrbitCamera frame_scene(const Scene& scene) {
  const std::optional<Bounds> bounds = scene_bounds(scene);
  if (!bounds) throw Error(scene.source, "has nothing that could be seen");
  if (scene.cameras.empty()) return frame_bounds(*bounds);
  OrbitCamera orbit;
  set_bounds(orbit, *bounds);
  adopt(orbit, scene.cameras.front());
  return orbit;
}

void orbit(OrbitCamera& camera, Vec2f drag) {
  camera.untouched.reset();
  camera.azimuth_radians = std::remainder(camera.azimuth_radians - pi * drag.x, 2 * pi);
  camera.elevation_radians =
      std::clamp(camera.elevation_radians - pi * drag.y, -max_elevation_radians, max_elevation_radians);
}

void pan(OrbitCamera& camera, Vec2f drag) {
  camera.untouched.reset();
  const Affine frame = to_camera(camera, 1e3f).to_world;
  const float metres = height_at_centre(camera);
  camera.centre = camera.centre - metres * (drag.x * frame.x + drag.y * frame.y);
  const Vec3f away = camera.centre - camera.home;
  const float far = 8 * camera.radius, reach = length(away);
  if (reach > far) camera.centre = camera.home + (far / reach) * away;
}

void zoom(OrbitCamera& camera, float factor) {
  camera.untouched.reset();
  const float least = 0.02f * camera.radius, most = 50 * camera.radius;
  if (camera.orthographic_height)
    camera.orthographic_height = std::clamp(*camera.orthographic_height * factor, least, most);
  else
    camera.distance = std::clamp(camera.distance * factor, least, most);
}

Vec3f eye_position(const OrbitCamera& camera) { return camera.centre + camera.distance * to_eye(camera); }

Camera to_camera(const OrbitCamera& orbit, float width_over_height) {
  Camera camera;
  if (orbit.untouched) {
    camera = *orbit.untouched;
  } else {
    camera.to_world = look_at(eye_position(orbit), orbit.centre, {0, 1, 0});
    camera.vertical_field_radians = orbit.vertical_field_radians;
    camera.orthographic_height = orbit.orthographic_height;
    camera.width_over_height = orbit.width_over_height;
  }
  if (orbit.width_over_height && width_over_height < *orbit.width_over_height)
    widen(camera, *orbit.width_over_height / width_over_height);
  return camera;
}

}  // namespace welkin
