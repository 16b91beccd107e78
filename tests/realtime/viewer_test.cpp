#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <welkin/realtime/view.h>
#include <welkin/realtime/viewer/false_color.h>
#include <welkin/realtime/viewer/orbit_camera.h>
#include <welkin/scene/built_in.h>

// The viewer's arithmetic: nothing here needs OpenGL.

namespace welkin {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

OrbitCamera unit_orbit() {
  OrbitCamera camera = frame_bounds({{-1, -1, -1}, {1, 1, 1}});
  orbit(camera, {0, 0});  // no longer untouched
  camera.centre = {};
  camera.azimuth_radians = camera.elevation_radians = 0;
  camera.distance = 4;
  return camera;
}

TEST(OrbitCamera, AFramedSceneIsSeenThroughItsOwnCamera) {
  const Scene scene = make_built_in_scene("spheres");
  const OrbitCamera framed = frame_scene(scene);
  const Camera own = scene.cameras[0], camera = to_camera(framed, *own.width_over_height);
  EXPECT_EQ(camera.to_world.origin, own.to_world.origin);
  EXPECT_EQ(camera.to_world.x, own.to_world.x);
  EXPECT_EQ(camera.vertical_field_radians, own.vertical_field_radians);
  // The first movement must not jump: the eye stays where it was (float angles, about 1e-6 of the distance).
  OrbitCamera moved = framed;
  orbit(moved, {0, 0});
  const Camera after = to_camera(moved, *own.width_over_height);
  EXPECT_LT(length(after.to_world.origin - own.to_world.origin), 1e-5f * framed.distance);
  EXPECT_LT(length(after.to_world.z - own.to_world.z), 1e-5f);
}

TEST(OrbitCamera, ASceneWithoutACameraIsSeenWhole) {
  const Bounds bounds{{2, -1, 5}, {4, 3, 6}};
  const OrbitCamera camera = frame_bounds(bounds);
  for (const float shape : {0.4f, 1.0f, 2.5f}) {
    const View view = make_view(to_camera(camera, shape), static_cast<int>(200 * shape), 200, bounds);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3f p{(corner & 1) != 0 ? 4.0f : 2.0f, (corner & 2) != 0 ? 3.0f : -1.0f,
                    (corner & 4) != 0 ? 6.0f : 5.0f};
      const float* m = view.world_to_clip.m;
      const float x = m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12];
      const float y = m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13];
      const float w = m[3] * p.x + m[7] * p.y + m[11] * p.z + m[15];
      EXPECT_LT(std::abs(x), w) << shape;
      EXPECT_LT(std::abs(y), w) << shape;
    }
  }
  Scene empty;
  empty.source = "nothing.obj";
  EXPECT_THROW(frame_scene(empty), std::exception);
}

TEST(OrbitCamera, AHalfHeightDragIsAQuarterTurn) {
  OrbitCamera camera = unit_orbit();
  EXPECT_NEAR(eye_position(camera).z, 4, 1e-6);
  orbit(camera, {-0.5f, 0});  // the scene is dragged to the left, so the eye goes to the right
  EXPECT_NEAR(eye_position(camera).x, 4, 1e-5);
  EXPECT_NEAR(eye_position(camera).z, 0, 1e-5);
  orbit(camera, {0, -0.25f});  // dragged down: the eye rises
  EXPECT_NEAR(eye_position(camera).y, 4 * std::sin(pi / 4), 1e-5);
}

TEST(OrbitCamera, StopsBelowThePolesAndTurnsForEver) {
  OrbitCamera camera = unit_orbit();
  for (int i = 0; i < 100; ++i) orbit(camera, {0.37f, -0.9f});
  EXPECT_FLOAT_EQ(camera.elevation_radians, max_elevation_radians);
  EXPECT_LE(std::abs(camera.azimuth_radians), pi);
  EXPECT_NO_THROW(to_camera(camera, 1));
  orbit(camera, {0, 50});
  EXPECT_FLOAT_EQ(camera.elevation_radians, -max_elevation_radians);
  EXPECT_NO_THROW(to_camera(camera, 1));
}

// A point in the plane through the centre stays under the pointer.
TEST(OrbitCamera, PanMovesWhatIsUnderThePointer) {
  OrbitCamera camera = unit_orbit();
  const float height = 2 * 4 * std::tan(0.5f * camera.vertical_field_radians);
  pan(camera, {0.25f, -0.1f});
  EXPECT_NEAR(camera.centre.x, -0.25f * height, 1e-5);
  EXPECT_NEAR(camera.centre.y, 0.1f * height, 1e-5);
  for (int i = 0; i < 200; ++i) pan(camera, {1, 0});
  EXPECT_NEAR(length(camera.centre - camera.home), 8 * camera.radius, 1e-3);
}

TEST(OrbitCamera, ZoomHasLimits) {
  OrbitCamera camera = unit_orbit();
  zoom(camera, 0.5f);
  EXPECT_FLOAT_EQ(camera.distance, 2);
  for (int i = 0; i < 40; ++i) zoom(camera, 0.5f);
  EXPECT_FLOAT_EQ(camera.distance, 0.02f * camera.radius);
  for (int i = 0; i < 40; ++i) zoom(camera, 2);
  EXPECT_FLOAT_EQ(camera.distance, 50 * camera.radius);
  camera.orthographic_height = 3;
  zoom(camera, 2);
  EXPECT_FLOAT_EQ(*to_camera(camera, 1).orthographic_height, 6);
}

TEST(OrbitCamera, NarrowPicturesKeepTheFramedWidth) {
  OrbitCamera camera = unit_orbit();
  camera.width_over_height = 2;
  const auto half_width = [&](float shape) {
    return shape * std::tan(0.5f * to_camera(camera, shape).vertical_field_radians);
  };
  EXPECT_NEAR(half_width(0.5f), half_width(2), 1e-5);
  EXPECT_FLOAT_EQ(to_camera(camera, 3).vertical_field_radians, camera.vertical_field_radians);
}

TEST(FalseColor, StopsAreMetAndBetweenThemIsTheirMean) {
  for (const ColorScale& colors : {signed_colors(), size_colors()}) {
    for (int i = 0; i < color_stops; ++i) {
      const Rgb c = false_color(colors, static_cast<float>(i) / (color_stops - 1));
      EXPECT_NEAR(c.g, colors[static_cast<std::size_t>(i)].g, 1e-6);
    }
    EXPECT_NEAR(false_color(colors, 0.5f / 6).b, 0.5f * (colors[0].b + colors[1].b), 1e-6);
    EXPECT_EQ(false_color(colors, -3).r, colors[0].r);
    EXPECT_EQ(false_color(colors, 7).r, colors[6].r);
  }
  EXPECT_EQ(max_channel(false_color(signed_colors(), 0.5f)), 0);
  for (std::size_t i = 1; i < color_stops; ++i)
    EXPECT_GT(luminance(size_colors()[i]), luminance(size_colors()[i - 1]));
}

TEST(FalseColor, ScalesAreNiceNumbersAndMarksAreEven) {
  EXPECT_DOUBLE_EQ(nice_scale(0.013), 0.02);
  EXPECT_DOUBLE_EQ(nice_scale(0.02), 0.02);
  EXPECT_DOUBLE_EQ(nice_scale(7), 10);
  EXPECT_DOUBLE_EQ(nice_scale(1), 1);
  EXPECT_DOUBLE_EQ(nice_scale(0), 1e-6);
  EXPECT_DOUBLE_EQ(nice_scale(std::nan("")), 1e-6);
  const auto marks = legend_marks(2, true);
  ASSERT_EQ(marks.size(), 5u);
  EXPECT_DOUBLE_EQ(marks[0].value, -2);
  EXPECT_DOUBLE_EQ(marks[2].value, 0);
  EXPECT_FLOAT_EQ(marks[3].position, 0.75f);
  EXPECT_DOUBLE_EQ(legend_marks(2, false)[1].value, 0.5);
}

// 200 pixels; the last one differs by 4, three others by 1 in one channel, one has no surface, one is NaN.
TEST(DifferenceNumbers, AreThoseOfAFewKnownPixels) {
  Image a(200, 1, 4), b(200, 1, 4);
  for (Image* image : {&a, &b})
    for (std::size_t i = 0; i < image->pixels.size(); ++i) image->pixels[i] = i % 4 == 3 ? 1.0f : 2.0f;
  a.at(199, 0)[0] += 4;
  for (int x = 3; x < 6; ++x) a.at(x, 0)[1] -= 1;
  a.at(7, 0)[0] = 100;
  a.at(7, 0)[3] = 0;
  b.at(8, 0)[2] = NAN;
  const DifferenceNumbers n = measure_difference(a, b);
  EXPECT_EQ(n.pixels, 198u);
  EXPECT_EQ(n.faults, 1u);
  EXPECT_NEAR(n.mean, (4 - 3) / (3 * 198.0), 1e-12);
  EXPECT_NEAR(n.rms, std::sqrt((16 + 3) / (3 * 198.0)), 1e-12);
  EXPECT_NEAR(n.relative_rms, n.rms / 2, 1e-12);
  EXPECT_DOUBLE_EQ(n.p99, 1);  // 196 of 198 is the first of at least 99 %: the third largest but one
  EXPECT_DOUBLE_EQ(n.largest, 4);
  EXPECT_EQ(measure_difference(Image(1, 1, 4), Image(1, 1, 4)).pixels, 0u);
}

TEST(DifferenceNumbers, ThreeChannelsMeanASurfaceEverywhere) {
  Image a(2, 2), b(2, 2);
  a.at(1, 1)[2] = 3;
  const DifferenceNumbers n = measure_difference(a, b);
  EXPECT_EQ(n.pixels, 4u);
  EXPECT_DOUBLE_EQ(n.largest, 3);
  EXPECT_DOUBLE_EQ(n.relative_rms, 0);
}

}  // namespace
}  // namespace welkin
