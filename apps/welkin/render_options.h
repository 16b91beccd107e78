#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "scene_input.h"

namespace welkin {

/// What the user asked `welkin render` for, as written; render_job.h makes a scene of it.
struct RenderCommand : SceneInput {
  std::string integrator = "path", sampling = "mis", heuristic = "power";
  std::uint32_t samples = 64, least_samples = 64, most_samples = 16384, seed = 0;
  bool samples_given = false;
  double error = 0;
  int bounces = 64;
  double occlusion_distance = 0;  ///< 0: everything
  double clamp = 0;
  bool hide_environment = false, no_shadows = false;
  std::string output, exposure = "auto", curve = "filmic";
  double watch_seconds = 0, state_seconds = 60;
  bool resume = false, keep_state = false;
};

void add_render_options(CLI::App& sub, RenderCommand& command);

/// Throws CLI::ValidationError for options that were given and that the others make void.
void check_contradictions(const CLI::App& sub, const RenderCommand& command);

}  // namespace welkin
