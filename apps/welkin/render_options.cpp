#include "render_options.h"

#include "environment_options.h"
#include "tone_input.h"

namespace welkin {
namespace {

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
  sub.add_flag("--no-shadows", command.no_shadows,
               "direct: the environment lights every surface as if nothing else were there, and other lights do "
               "not: what precomputed maps approximate");
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
  add_tone_options(sub, command.exposure, command.curve);
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
  sub.add_flag("--hide-env", command.hide_environment,
               "Black behind the scene; the environment still lights it");
  add_camera_options(sub, command);
  add_sampling_options(sub, command);
  add_output_options(sub, command);
}

}  // namespace welkin
