#include <gtest/gtest.h>

#include <algorithm>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/occlusion/screen_occlusion.h>
#include <welkin/realtime/view.h>
#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

struct Drawn {
  Image depth, normal, openness;
};

Drawn draw_openness(const Scene& scene, const OcclusionOptions& options, int width = 96, int height = 64) {
  const GpuScene gpu = upload_scene(scene);
  const View view = make_view(scene.cameras[0], width, height, gpu.bounds);
  ScreenOcclusion occlusion;
  const Fullscreen fullscreen;
  PassTimer timer;
  occlusion.draw(gpu, view, options, fullscreen, timer);
  return {read_pixels(occlusion.geometry().target(), 0), read_pixels(occlusion.geometry().target(), 1),
          read_pixels(occlusion.openness())};
}

Camera camera_from(Vec3f eye, Vec3f target) {
  Camera camera;
  camera.to_world = look_at(eye, target, {0, 1, 0});
  camera.vertical_field_radians = 0.7f;
  camera.width_over_height = 1.5f;
  return camera;
}

// The ground y = 0, 40 m wide.
Scene open_plane() {
  Scene scene;
  const int material = add_material(scene, {});
  add_instance(scene, add_mesh(scene, make_rectangle({-20, 0, 20}, {40, 0, 0}, {0, 0, -40}), material));
  scene.cameras.push_back(camera_from({0, 3, 4}, {0, 0, 0}));
  return scene;
}

class OpenPlane : public ::testing::TestWithParam<OcclusionMethod> {};

// Nothing stands on it, so every method must call it open; the ball, half of which is under ground, half open.
TEST_P(OpenPlane, IsOpen) {
  const HeadlessContext context;
  {
    OcclusionOptions options;
    options.method = GetParam();
    const Drawn drawn = draw_openness(open_plane(), options);
    const bool ball = GetParam() == OcclusionMethod::sphere;
    double sum = 0;
    for (int y = 8; y < 56; ++y) {
      for (int x = 8; x < 88; ++x) sum += drawn.openness.at(x, y)[3];
    }
    // Few points near a tilted wall fall into the pixels they came from: 2 %.
    EXPECT_NEAR(sum / (48 * 80), ball ? 0.5 : 1.0, ball ? 0.02 : 1e-3);
  }
  for (const int living : living_gl_objects()) EXPECT_EQ(living, 0);
}

INSTANTIATE_TEST_SUITE_P(Methods, OpenPlane,
                         ::testing::Values(OcclusionMethod::sphere, OcclusionMethod::hemisphere));

// The plane's distance along the axis, and its normal, at every pixel, from the camera alone.
TEST(GeometryPass, GivesDepthAndNormalOfAPlane) {
  const HeadlessContext context;
  const Scene scene = open_plane();
  const Drawn drawn = draw_openness(scene, {});
  const Affine& eye = scene.cameras[0].to_world;
  const View view = make_view(scene.cameras[0], 96, 64, {{-20, 0, -20}, {20, 0, 20}});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const Vec3f ray = view.ray_corner + (static_cast<float>(x) + 0.5f) / 96 * view.ray_right +
                        (63.5f - static_cast<float>(y)) / 64 * view.ray_up;
      const float depth = drawn.depth.at(x, y)[0];
      EXPECT_NEAR(eye.origin.y + depth * ray.y, 0, 1e-4f);  // rounding of interpolation over 20 m
      const float* n = drawn.normal.at(x, y);
      EXPECT_NEAR(n[0] * eye.x.y + n[1] * eye.y.y + n[2] * eye.z.y, 1, 1e-3f);  // half floats
    }
  }
}

}  // namespace
}  // namespace welkin
