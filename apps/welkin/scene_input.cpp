#include "scene_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include <welkin/error.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/read_scene.h>

#include "environment_options.h"

namespace welkin {
namespace {

std::string scene_help() {
  std::string text = "A built-in scene in place of FILE, NAME or NAME:key=value,...:";
  for (const BuiltInScene& scene : built_in_scenes()) text += " " + std::string(scene.name) + ",";
  text.pop_back();
  return text;
}

Vec3f parse_point(const std::string& option, const std::string& text) {
  float numbers[3] = {};
  const char *at = text.data(), *end = text.data() + text.size();
  for (int i = 0; i < 3; ++i) {
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    const bool last = i == 2,
               good = error == std::errc() && std::isfinite(numbers[i]) && std::abs(numbers[i]) < 1e12f;
    if (!good || (last ? next != end : next == end || *next != ','))
      throw CLI::ValidationError(option, "needs three finite numbers X,Y,Z, not '" + text + "'");
    at = next + 1;
  }
  return {numbers[0], numbers[1], numbers[2]};
}

PictureSize parse_size(const std::string& text) {
  PictureSize size;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [cross, first] = std::from_chars(begin, end, size.width);
  const bool crossed = first == std::errc() && cross != end && *cross == 'x';
  const auto [rest, second] = crossed ? std::from_chars(cross + 1, end, size.height)
                                      : std::from_chars_result{cross, std::errc::invalid_argument};
  if (second != std::errc() || rest != end || size.width < 1 || size.height < 1 || size.width > 16384 ||
      size.height > 16384 || std::int64_t{size.width} * size.height > 1 << 26)
    throw CLI::ValidationError("--size", "needs WIDTHxHEIGHT from 1x1 to 16384x4096, not '" + text + "'");
  return size;
}

// About 300,000 pixels.
PictureSize default_size(const Camera& camera) {
  const double proportion = std::clamp<double>(camera.width_over_height.value_or(4.0f / 3), 0.05, 20);
  const double height = std::round(std::sqrt(300000 / proportion));
  return {static_cast<int>(std::round(height * proportion)), static_cast<int>(height)};
}

std::string camera_names(const Scene& scene) {
  std::string names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    names += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, scene.cameras[i].name);
  return names.empty() ? "it has none" : "it has " + names;
}

Camera named_camera(const SceneInput& input, const Scene& scene) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == input.camera) return camera;
  std::size_t index = 0;
  const char* end = input.camera.data() + input.camera.size();
  const auto [rest, error] = std::from_chars(input.camera.data(), end, index);
  if (error != std::errc() || rest != end || index >= scene.cameras.size())
    throw CLI::ValidationError(
        "--camera", fmt::format("the scene has no camera '{}'; {}", input.camera, camera_names(scene)));
  return scene.cameras[index];
}

Camera choose_camera(const SceneInput& input, const Scene& scene) {
  if (!input.camera.empty()) return named_camera(input, scene);
  if (!scene.cameras.empty()) return scene.cameras.front();
  const std::optional<Bounds> bounds = scene_bounds(scene);
  if (!bounds) throw Error(scene.source, "has nothing that could be seen");
  const PictureSize size = input.size.empty() ? PictureSize{4, 3} : parse_size(input.size);
  return default_camera(*bounds, static_cast<double>(size.width) / size.height);
}

Vec3f middle(const Scene& scene) {
  const std::optional<Bounds> bounds = scene_bounds(scene);
  return bounds ? 0.5f * (bounds->low + bounds->high) : Vec3f{};
}

}  // namespace

void add_scene_options(CLI::App& sub, SceneInput& input) {
  sub.add_option("FILE", input.file, "A scene: .gltf, .glb, .obj or .ply; or the name of a built-in one");
  sub.add_option("--scene", input.scene_name, scene_help());
  sub.add_option(
      "--env", input.environment,
      "What lights it: an HDR file, sky:... or none; sky: where the scene has no light of its own");
  sub.add_option("--env-mapping", input.mapping, "What a flat environment shows: equirectangular, cube, ...")
      ->check(is_mapping());
  sub.add_option("--env-rotate", input.environment_options.rotate_degrees,
                 "Turn the environment about +Y by so many degrees")
      ->check(must_be_finite);
  sub.add_flag("--env-mirror", input.environment_options.mirror, "Swap left and right of the environment");
  sub.add_option("--faults", input.faults,
                 "NaN, infinite and negative values of the environment: repair or refuse")
      ->check(CLI::IsMember({"repair", "refuse"}))
      ->capture_default_str();
}

void add_camera_options(CLI::App& sub, SceneInput& input) {
  sub.add_option("--camera", input.camera, "Of the scene's cameras: a name, or a number from 0");
  sub.add_option("--eye", input.eye, "Where the camera stands, X,Y,Z in metres");
  sub.add_option("--look-at", input.look_at, "What it looks at, X,Y,Z in metres");
  sub.add_option("--fov", input.field_degrees, "Vertical field of view in degrees")
      ->check(must_be_finite)
      ->check(CLI::Range(0.01, 179.0));
  sub.add_option("--size", input.size,
                 "WIDTHxHEIGHT in pixels; about 300,000 pixels of the camera's proportions");
}

Scene load_scene(const SceneInput& input) {
  if (input.file.empty() == input.scene_name.empty())
    throw CLI::ValidationError("FILE", "needs either a scene FILE or --scene NAME");
  if (!input.scene_name.empty()) {
    try {
      return make_built_in_scene(input.scene_name);
    } catch (const Error& error) {
      throw CLI::ValidationError("--scene", error.what());
    }
  }
  return std::filesystem::exists(input.file) ? read_scene(input.file) : open_scene(input.file);
}

PictureSize picture_size(const SceneInput& input, const Camera& camera) {
  return input.size.empty() ? default_size(camera) : parse_size(input.size);
}

Camera aimed_camera(const SceneInput& input, const Scene& scene) {
  Camera camera = choose_camera(input, scene);
  if (!input.eye.empty() || !input.look_at.empty()) {
    const Vec3f eye = input.eye.empty() ? camera.to_world.origin : parse_point("--eye", input.eye);
    const Vec3f target = input.look_at.empty() ? middle(scene) : parse_point("--look-at", input.look_at);
    const Vec3f view = target - eye;
    if (!(length(view) > 0)) throw CLI::ValidationError("--look-at", "is where the camera stands");
    const bool upright = std::hypot(view.x, view.z) > 1e-4f * length(view);
    camera.to_world = look_at(eye, target, upright ? Vec3f{0, 1, 0} : Vec3f{0, 0, -1});
  }
  if (input.field_degrees > 0) {
    camera.vertical_field_radians = static_cast<float>(input.field_degrees * std::numbers::pi / 180);
    camera.orthographic_height.reset();
  }
  return camera;
}

Environment load_surroundings(const SceneInput& input, const std::string& name) {
  EnvironmentOptions options = input.environment_options;
  options.faults = input.faults == "refuse" ? FaultPolicy::refuse : FaultPolicy::repair;
  if (!input.mapping.empty()) options.mapping = mapping_from_name(input.mapping);
  return load_environment(name, options);
}

}  // namespace welkin
