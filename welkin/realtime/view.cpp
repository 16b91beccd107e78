#include <welkin/realtime/view.h>

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

// Rows of a rigid frame's inverse: the frame has unit axes at right angles.
Matrix4 rigid_inverse(const Affine& a) {
  return {{a.x.x, a.y.x, a.z.x, 0, a.x.y, a.y.y, a.z.y, 0, a.x.z, a.y.z, a.z.z, 0, -dot(a.x, a.origin),
           -dot(a.y, a.origin), -dot(a.z, a.origin), 1}};
}

// Half extents at distance 1 from the eye; the window from -x to x, -y to y is what the picture shows.
Matrix4 perspective(float half_width, float half_height, float near, float far) {
  return {{1 / half_width, 0, 0, 0, 0, 1 / half_height, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0,
           2 * far * near / (near - far), 0}};
}

Matrix4 parallel(float half_width, float half_height, float near, float far) {
  return {{1 / half_width, 0, 0, 0, 0, 1 / half_height, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0,
           (far + near) / (near - far), 1}};
}

struct DepthRange {
  float near, far;
};

// Along the axis from the eye, over the corners of the box.
DepthRange depth_range(const Affine& eye, const Bounds& b) {
  float nearest = 1e30f, farthest = -1e30f;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3f p{(corner & 1) != 0 ? b.high.x : b.low.x, (corner & 2) != 0 ? b.high.y : b.low.y,
                  (corner & 4) != 0 ? b.high.z : b.low.z};
    const float depth = -dot(p - eye.origin, eye.z);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  return {nearest, farthest};
}

void set_projection(View& view, const Camera& camera, const Bounds& bounds) {
  const DepthRange range = depth_range(camera.to_world, bounds);
  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  const Affine& eye = camera.to_world;
  float half_height = 0;
  if (view.orthographic) {
    half_height = 0.5f * *camera.orthographic_height;
    const float reach = std::max(1e-3f, 0.01f * (range.far - range.near));
    view.near_metres = std::max(0.0f, range.near - reach);  // rays begin in the plane of the eye
    view.far_metres = std::max(view.near_metres + reach, range.far + reach);
    view.view_to_clip = parallel(aspect * half_height, half_height, view.near_metres, view.far_metres);
  } else {
    half_height = std::tan(0.5f * camera.vertical_field_radians);
    view.far_metres = std::max(1e-3f, 1.01f * range.far);
    view.near_metres = std::max(0.99f * range.near, 1e-4f * view.far_metres);
    view.view_to_clip = perspective(aspect * half_height, half_height, view.near_metres, view.far_metres);
  }
  view.ray_right = 2 * aspect * half_height * eye.x;
  view.ray_up = 2 * half_height * eye.y;
  const Vec3f middle = view.orthographic ? eye.origin : -eye.z;
  view.ray_corner = middle - 0.5f * view.ray_right - 0.5f * view.ray_up;
}

}  // namespace

Matrix4 multiply(const Matrix4& a, const Matrix4& b) {
  Matrix4 product;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      float sum = 0;
      for (int k = 0; k < 4; ++k) sum += a.m[4 * k + row] * b.m[4 * column + k];
      product.m[4 * column + row] = sum;
    }
  }
  return product;
}

Matrix4 to_matrix(const Affine& a) {
  return {{a.x.x, a.x.y, a.x.z, 0, a.y.x, a.y.y, a.y.z, 0, a.z.x, a.z.y, a.z.z, 0, a.origin.x, a.origin.y,
           a.origin.z, 1}};
}

View make_view(const Camera& camera, int width, int height, const Bounds& bounds) {
  View view;
  view.width = width;
  view.height = height;
  view.eye = camera.to_world.origin;
  view.forward = -camera.to_world.z;
  view.orthographic = camera.orthographic_height.has_value();
  view.world_to_view = rigid_inverse(camera.to_world);
  set_projection(view, camera, bounds);
  view.world_to_clip = multiply(view.view_to_clip, view.world_to_view);
  return view;
}

View make_cube_face_view(Vec3f centre, int face, int size, float near_metres, float far_metres) {
  // Rows of a cube face are stored from its top and the picture's rows from the bottom, so t grows with y on the screen. The three
  // axes are those of cube_ray: d = middle + s across + t down.
  static constexpr Vec3f middle[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  static constexpr Vec3f across[6] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}};
  static constexpr Vec3f down[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
  View view;
  view.width = view.height = size;
  view.eye = centre;
  view.forward = middle[face];
  const Affine frame{across[face], down[face], -middle[face], centre};
  view.world_to_view = rigid_inverse(frame);
  view.near_metres = near_metres;
  view.far_metres = far_metres;
  view.view_to_clip = perspective(1, 1, near_metres, far_metres);
  view.world_to_clip = multiply(view.view_to_clip, view.world_to_view);
  view.ray_right = 2 * across[face];
  view.ray_up = 2 * down[face];
  view.ray_corner = middle[face] - across[face] - down[face];
  return view;
}

}  // namespace welkin
