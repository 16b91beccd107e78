#include "dynamic_test_scene.h"

#include <cmath>
#include <random>

#include <welkin/sphere/cube.h>

namespace welkin {

namespace {

std::shared_ptr<const EnvironmentData> make_noise_light() {
  Image image(64, 32, 3);
  std::mt19937 engine(7);
  for (float& value : image.pixels) value = 0.2f + 0.8f * static_cast<float>(engine() >> 8) / 16777216.0f;
  for (int lamp = 0; lamp < 3; ++lamp)
    for (int c = 0; c < 3; ++c) image.at(9 + 20 * lamp, 8 + 3 * lamp)[c] = static_cast<float>(60 - 15 * c);
  IblOptions options;
  options.size = 32;
  options.irradiance_size = 16;
  return make_environment_data(std::move(image), options);
}

}  // namespace

std::shared_ptr<const EnvironmentData> noise_light() {
  static const auto light = make_noise_light();
  return light;
}

CapturedRoom::CapturedRoom(SurroundingsKind kind, CaptureInput input, int size, int patches,
                           double time_seconds)
    : environment(upload_environment(noise_light()->maps)),
      surroundings(kind, {{-1, -1, -1}, {1, 1, 1}}, patches),
      capture(input, size) {
  const Fullscreen fullscreen;
  surroundings.move_to(time_seconds, 150);
  capture.capture(surroundings, {0, &environment, {}}, {}, fullscreen);
}

std::array<double, 3> sum_over_cube(const Cube& cube, Vec3 axis, const ZonalKernel& kernel) {
  std::array<double, 3> sum{};
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < cube.size; ++y)
      for (int x = 0; x < cube.size; ++x) {
        const double u = 1 - dot(cube_texel_direction(cube.size, face, x, y), axis);
        const double weight = evaluate(kernel, std::max(0.0, u)) * cube_texel_solid_angle(cube.size, x, y);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * static_cast<double>(cube.at(face, x, y)[c]);
      }
  return sum;
}

Scene lone_sphere(const Material& material) {
  Scene scene;
  scene.source = "lone sphere";
  scene.materials.push_back(material);
  scene.spheres.push_back({{0, 0, 0}, 1, 0});
  Camera camera;
  camera.to_world = look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
  camera.orthographic_height = 2.2f;
  scene.cameras.push_back(camera);
  return scene;
}

std::optional<Vec3> lone_sphere_normal(int size, int x, int y) {
  const double px = 2.2 * ((x + 0.5) / size - 0.5), py = 2.2 * (0.5 - (y + 0.5) / size);
  const double squared = px * px + py * py;
  if (squared > 0.9) return std::nullopt;
  return Vec3{px, py, std::sqrt(1 - squared)};
}

}  // namespace welkin
