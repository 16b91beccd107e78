#pragma once
#include <optional>

#include <welkin/scene/scene.h>

namespace welkin {

/// A camera that a user turns about a point. Movements are in fractions of the picture's height, x rightwards and y upwards, the same for
/// a mouse and a finger on any screen.
struct OrbitCamera {
  Vec3f centre;                 ///< what it turns about and looks at
  float distance = 1;           ///< metres from the centre to the eye
  float azimuth_radians = 0;    ///< of the eye as seen from the centre: 0 at +Z, pi/2 at +X
  float elevation_radians = 0;  ///< above the horizontal plane
  float vertical_field_radians = 0.7f;
  std::optional<float> orthographic_height;  ///< metres
  std::optional<float>
      width_over_height;  ///< narrower pictures get a wider vertical field, so that what was framed stays in
  Vec3f home;             ///< middle of the scene: pan stays within 8 radii of it
  float radius = 1;       ///< of the sphere around the scene, metres
  /// The scene's own camera, roll included, until the first movement.
  std::optional<Camera> untouched;
};

inline constexpr float max_elevation_radians = 1.55f;  ///< at the pole, up would not be known

/// The scene's first camera, turning about the point of its axis that is nearest to the middle of the scene; a camera that
/// sees all of the scene where it has none. Throws Error naming the scene for one without geometry.
OrbitCamera frame_scene(const Scene& scene);

/// Sees all of the bounds from the front, slightly from above.
OrbitCamera frame_bounds(const Bounds& bounds);

/// Moves the eye about the centre as if the scene were dragged: a picture's height is half a turn. Stops near the poles.
void orbit(OrbitCamera& camera, Vec2f drag);

/// Moves the centre in the picture's plane, so that what is there stays under the pointer.
void pan(OrbitCamera& camera, Vec2f drag);

/// Multiplies the distance (the height of an orthographic picture) by `factor` > 0, between 1/50 and 50 radii.
void zoom(OrbitCamera& camera, float factor);

Vec3f eye_position(const OrbitCamera& camera);

/// For a picture of these proportions.
Camera to_camera(const OrbitCamera& camera, float width_over_height);

}  // namespace welkin
