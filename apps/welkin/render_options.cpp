#include "render_options.h"

#include <welkin/scene/built_in.h>

#include "environment_options.h"

namespace welkin {
namespace {

std::string scene_help() {
  std::string text = "A built-in scene in place of FILE, NAME or NAME:key=value,...:";
  for (const BuiltInScene& scene : built_in_scenes()) text += " " + std::string(scene.name) + ",";
  text.pop_back();
  return text;
}

void add_scene_options(CLI::App& sub, RenderCommand& command) {
  sub.add_option("FILE", command.file, "A scene: .gltf, .glb, .obj or .ply; or the name of a built-in one");
  sub.add_option("--scene", command.scene_name, scene_help());
  sub.add_option(
      "--env", command.environment,
      "What lights it: an HDR file, sky:... or none; sky: where the scene has no light of its own");
  sub.add_option("--env-mapping", command.mapping,
                 "What a flat environment shows: equirectangular, cube, ...")
      ->check(is_mapping());
  sub.add_option("--env-rotate", command.environment_options.rotate_degrees,
                 "Turn the environment about +Y by so many degrees")
      ->check(must_be_finite);
  sub.add_flag("--env-mirror", command.environment_options.mirror, "Swap left and right of the environment");
  sub.add_option("--faults", command.faults,
                 "NaN, infinite and negative values of the environment: repair or refuse")
      ->check(CLI::IsMember({"repair", "refuse"}))
      ->capture_default_str();
  sub.add_flag("--hide-env", command.hide_environment,
               "Black behind the scene; the environment still lights it");
}

void add_camera_options(CLI::App& sub, RenderCommand& command) {
  sub.add_option("--camera", command.camera, "Of the scene's cameras: a name, or a number from 0");
  sub.add_option("--eye", command.eye, "Where the camera stands, X,Y,Z in metres");
  sub.add_option("--look-at", command.look_at, "What it looks at, X,Y,Z in metres");
  sub.add_option("--fov", command.field_degrees, "Vertical field of view in degrees")
      ->check(must_be_finite)
      ->check(CLI::Range(0.01, 179.0));
  sub.add_option("--size", command.size,
                 "WIDTHxHEIGHT in pixels; about 300,000 pixels of the camera's proportions");
}

void add_sampling_options(CLI::App& sub, RenderCommand& command) {
  auto* samples = sub.add_option("--spp", command.samples, "Samples a pixel")
                      ->check(CLI::Range(1u, 1u << 24))
                      ->capture_default_str();
  auto* error =
      sub.add_option("--error", command.error,
                     "In place of --spp: sample until the standard error of each pixel's luminance is at "
                     "most this share of the luminance about it (or of the picture's log-average, "
                     "where it is darker)")
          ->check(must_be_finite)
          ->check(CLI::Range(1e-5, 10.0));
  samples->excludes(error);
  sub.add_option("--min-spp", command.least_samples, "With --error: what every pixel gets")
      ->check(CLI::Range(16u, 1u << 24))
      ->capture_default_str();
  sub.add_option("--max-spp", command.most_samples, "With --error: the most that a pixel gets")
      ->check(CLI::Range(16u, 1u << 24))
      ->capture_default_str();
  sub.add_option("--integrator,--shading", command.integrator,
                 "path, direct (no light between surfaces), ao (ambient occlusion), ibl (as a real-time "
                 "engine shades)")
      ->check(CLI::IsMember({"path", "direct", "ao", "ibl"}))
      ->capture_default_str();
  sub.add_option(
         "--sampling", command.sampling,
         "How light is looked for: bsdf, light, mis (both), product (with mis); compare shows all of them")
      ->check(CLI::IsMember({"bsdf", "light", "mis", "product", "compare"}))
      ->capture_default_str();
  sub.add_option("--heuristic", command.heuristic, "Weights of mis: power or balance")
      ->check(CLI::IsMember({"power", "balance"}))
      ->capture_default_str();
  sub.add_option("--bounces", command.bounces, "path: the most reflections after the first surface")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  sub.add_option("--ao-distance", command.occlusion_distance, "ao: how far to look, metres; 0 is everything")
      ->check(must_be_finite)
      ->check(CLI::Range(0.0, 1e12))
      ->capture_default_str();
  sub.add_option("--clamp", command.clamp,
                 "The most radiance of one indirect contribution: fewer specks, less light; 0 leaves all")
      ->check(must_be_finite)
      ->check(CLI::Range(0.0, 1e12))
      ->capture_default_str();
  sub.add_option("--seed", command.seed, "Other numbers give an independent picture")->capture_default_str();
}

void add_output_options(CLI::App& sub, RenderCommand& command) {
  sub.add_option(
         "-o,--output", command.output,
         "FILE.exr: radiance and layers for standard error, albedo, normal, depth, coverage, samples; "
         "FILE.png beside it")
      ->required()
      ->check(must_be_a_name);
  sub.add_option("--exposure", command.exposure, "PNG: stops, or auto")->capture_default_str();
  sub.add_option("--curve", command.curve, "PNG: filmic, srgb (clipped) or reinhard")
      ->check(CLI::IsMember({"filmic", "srgb", "reinhard"}))
      ->capture_default_str();
  sub.add_option("--watch", command.watch_seconds,
                 "Rewrite both files every so many seconds; 0: at the end only")
      ->check(must_be_finite)
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  sub.add_option("--state-every", command.state_seconds,
                 "Seconds between two FILE.exr.state to go on with; 0: none")
      ->check(must_be_finite)
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  sub.add_flag("--resume", command.resume, "Go on with FILE.exr.state, if there is one, to the same picture");
  sub.add_flag(
      "--keep-state", command.keep_state,
      "Leave FILE.exr.state at the end, for more samples with --resume and a larger --spp (the same bytes "
      "as at once where the first --spp is a multiple of 16)");
}

}  // namespace

void add_render_options(CLI::App& sub, RenderCommand& command) {
  add_scene_options(sub, command);
  add_camera_options(sub, command);
  add_sampling_options(sub, command);
  add_output_options(sub, command);
}

}  // namespace welkin
