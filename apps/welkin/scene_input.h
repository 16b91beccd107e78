#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include <welkin/envmap/environment.h>
#include <welkin/pathtrace/integrator.h>
#include <welkin/scene/scene.h>

// What `welkin render`, `frame` and `view` have in common: a scene, what lights it and who looks at it.

namespace welkin {

/// As the user wrote it.
struct SceneInput {
  std::string file, scene_name;
  std::string environment, mapping, faults = "repair";
  EnvironmentOptions environment_options;
  std::string size, camera, eye, look_at;
  double field_degrees = 0;  ///< 0: the camera's own
};

void add_scene_options(CLI::App& sub, SceneInput& input);
void add_camera_options(CLI::App& sub, SceneInput& input);

// These throw CLI::ValidationError for what is wrong with an option and Error for what is wrong with a file.

Scene load_scene(const SceneInput& input);
/// `name` in place of input.environment, which may be empty.
Environment load_surroundings(const SceneInput& input, const std::string& name);
/// The camera that was asked for, the scene's first, or one that frames it.
Camera aimed_camera(const SceneInput& input, const Scene& scene);
/// --size, or about 300,000 pixels of the camera's proportions.
PictureSize picture_size(const SceneInput& input, const Camera& camera);

}  // namespace welkin
