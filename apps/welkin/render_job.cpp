#include "render_job.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include <welkin/error.h>
#include <welkin/pathtrace/fingerprint.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/read_scene.h>

namespace welkin {
namespace {

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

bool has_light(const Scene& scene) {
  return !scene.lights.empty() || std::any_of(scene.materials.begin(), scene.materials.end(),
                                              [](const Material& m) { return !is_black(m.emission); });
}

Scene load_scene(const RenderCommand& command) {
  if (command.file.empty() == command.scene_name.empty())
    throw CLI::ValidationError("render", "needs either a scene FILE or --scene NAME");
  if (!command.scene_name.empty()) {
    try {
      return make_built_in_scene(command.scene_name);
    } catch (const Error& error) {
      throw CLI::ValidationError("--scene", error.what());
    }
  }
  return std::filesystem::exists(command.file) ? read_scene(command.file) : open_scene(command.file);
}

std::string camera_names(const Scene& scene) {
  std::string names;
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    names += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, scene.cameras[i].name);
  return names.empty() ? "it has none" : "it has " + names;
}

Camera named_camera(const RenderCommand& command, const Scene& scene) {
  for (const Camera& camera : scene.cameras)
    if (camera.name == command.camera) return camera;
  std::size_t index = 0;
  const char* end = command.camera.data() + command.camera.size();
  const auto [rest, error] = std::from_chars(command.camera.data(), end, index);
  if (error != std::errc() || rest != end || index >= scene.cameras.size())
    throw CLI::ValidationError(
        "--camera", fmt::format("the scene has no camera '{}'; {}", command.camera, camera_names(scene)));
  return scene.cameras[index];
}

Camera choose_camera(const RenderCommand& command, const Scene& scene) {
  if (!command.camera.empty()) return named_camera(command, scene);
  if (!scene.cameras.empty()) return scene.cameras.front();
  const std::optional<Bounds> bounds = scene_bounds(scene);
  if (!bounds) throw Error(scene.source, "has nothing that could be seen");
  const PictureSize size = command.size.empty() ? PictureSize{4, 3} : parse_size(command.size);
  return default_camera(*bounds, static_cast<double>(size.width) / size.height);
}

Vec3f middle(const Scene& scene) {
  const std::optional<Bounds> bounds = scene_bounds(scene);
  return bounds ? 0.5f * (bounds->low + bounds->high) : Vec3f{};
}

Camera aimed_camera(const RenderCommand& command, const Scene& scene) {
  Camera camera = choose_camera(command, scene);
  if (!command.eye.empty() || !command.look_at.empty()) {
    const Vec3f eye = command.eye.empty() ? camera.to_world.origin : parse_point("--eye", command.eye);
    const Vec3f target = command.look_at.empty() ? middle(scene) : parse_point("--look-at", command.look_at);
    const Vec3f view = target - eye;
    if (!(length(view) > 0)) throw CLI::ValidationError("--look-at", "is where the camera stands");
    const bool upright = std::hypot(view.x, view.z) > 1e-4f * length(view);
    camera.to_world = look_at(eye, target, upright ? Vec3f{0, 1, 0} : Vec3f{0, 0, -1});
  }
  if (command.field_degrees > 0) {
    camera.vertical_field_radians = static_cast<float>(command.field_degrees * std::numbers::pi / 180);
    camera.orthographic_height.reset();
  }
  return camera;
}

Environment load_surroundings(const RenderCommand& command, const std::string& name) {
  EnvironmentOptions options = command.environment_options;
  options.faults = command.faults == "refuse" ? FaultPolicy::refuse : FaultPolicy::repair;
  if (!command.mapping.empty()) options.mapping = mapping_from_name(command.mapping);
  return load_environment(name, options);
}

LightSampling sampling_of(const std::string& name) {
  if (name == "bsdf") return LightSampling::bsdf;
  if (name == "light") return LightSampling::light;
  return name == "product" ? LightSampling::product : LightSampling::mis;
}

Integrator integrator_of(const std::string& name) {
  if (name == "direct") return Integrator::direct;
  if (name == "ao") return Integrator::ambient_occlusion;
  return name == "ibl" ? Integrator::image_based : Integrator::path;
}

PictureOptions picture_options(const RenderCommand& command, const Camera& camera) {
  PictureOptions options;
  options.size = command.size.empty() ? default_size(camera) : parse_size(command.size);
  options.target_error = command.error;
  options.samples = command.error > 0 ? command.most_samples : command.samples;
  options.least_samples = std::min(command.least_samples, options.samples);
  IntegratorOptions& integrator = options.integrator;
  integrator.integrator = integrator_of(command.integrator);
  integrator.sampling = sampling_of(command.sampling);
  integrator.heuristic = command.heuristic == "balance" ? MisHeuristic::balance : MisHeuristic::power;
  integrator.max_bounces = command.bounces;
  if (command.occlusion_distance > 0)
    integrator.occlusion_distance = static_cast<float>(command.occlusion_distance);
  integrator.clamp_indirect = static_cast<float>(command.clamp);
  integrator.show_environment = !command.hide_environment;
  integrator.seed = command.seed;
  return options;
}

}  // namespace

RenderJob make_render_job(const RenderCommand& command) {
  RenderJob job;
  job.scene = load_scene(command);
  for (const std::string& warning : job.scene.warnings)
    job.warnings.push_back(job.scene.source + ": " + warning);
  job.camera = aimed_camera(command, job.scene);
  job.options = picture_options(command, job.camera);
  const std::string name = !command.environment.empty() ? command.environment
                           : has_light(job.scene)       ? "none"
                                                        : "sky:";
  if (name == "none") {
    if (job.options.integrator.integrator == Integrator::image_based)
      throw Error("--integrator ibl shades by an environment: give one with --env");
    if (!has_light(job.scene) && job.options.integrator.integrator != Integrator::ambient_occlusion)
      job.warnings.push_back(job.scene.source +
                             ": has no light, and neither has --env none: the picture is black");
    job.fingerprint = picture_fingerprint(job.scene, job.camera, nullptr, job.options);
    return job;
  }
  Environment environment = load_surroundings(command, name);
  for (const std::string& warning : environment.warnings) job.warnings.push_back(name + ": " + warning);
  job.fingerprint = picture_fingerprint(job.scene, job.camera, &environment.radiance, job.options);
  if (job.options.integrator.integrator == Integrator::image_based) {
    const IblOptions ibl;
    job.image_based =
        std::make_unique<ImageBasedLight>(make_image_based_light(make_ibl(environment.radiance, ibl), ibl));
    job.options.integrator.image_based = job.image_based.get();
  }
  job.environment.emplace(std::move(environment.radiance));
  return job;
}

}  // namespace welkin
