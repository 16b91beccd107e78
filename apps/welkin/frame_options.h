#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "scene_input.h"

namespace welkin {

/// What the user asked `welkin frame` for, as written; frame_picture.h draws it.
struct FrameCommand : SceneInput {
  std::string technique = "prefiltered-ggx";
  double rotate_degrees = 0, time_seconds = 0;
  int frames = 0;  ///< 0: one, or default_progressive_frames
  int supersample = 1;
  int map_size = 256;
  std::string maps = "half";
  bool hide_environment = false;
  std::string output, exposure = "auto", curve = "filmic";
  std::string reference;  ///< samples a pixel or a file; empty: the default
  bool reference_given = false;
  std::string sheet;     ///< file; empty: none
  std::string shaders;   ///< folder; empty: none
  int timed_frames = 0;  ///< 0: not timed
  bool list = false, json = false;
};

void add_frame_options(CLI::App& sub, FrameCommand& command);

}  // namespace welkin
