#pragma once
#include <welkin/realtime/gl/program.h>
#include <welkin/scene/scene.h>

namespace welkin {

/// A camera made ready for a picture of width x height pixels: the same rays as CameraRays of the path tracer has.
struct View {
  int width = 0, height = 0;
  Matrix4 world_to_view, view_to_clip, world_to_clip;
  Vec3f eye, forward;  ///< world; forward: unit, into the picture
  bool orthographic = false;
  /// perspective: the ray through (u, v), both in [0, 1] from the bottom left, is ray_corner + u ray_right + v ray_up, its length 1 along
  /// the axis; orthographic: the point in the plane of the eye that the ray starts in.
  Vec3f ray_corner, ray_right, ray_up;
  float near_metres = 0, far_metres = 0;
};

/// near and far are chosen from the bounds of what is to be seen.
View make_view(const Camera& camera, int width, int height, const Bounds& bounds);

/// One face of a cube that is drawn from `centre`: 90 degrees, in the orientation of cube maps (rows as stored: face order +X -X +Y -Y +Z -Z).
View make_cube_face_view(Vec3f centre, int face, int size, float near_metres, float far_metres);

Matrix4 multiply(const Matrix4& a, const Matrix4& b);
Matrix4 to_matrix(const Affine& a);

}  // namespace welkin
