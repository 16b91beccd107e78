#pragma once
#include <optional>
#include <string>

#include <welkin/realtime/viewer/viewer_state.h>

namespace welkin {

/// What the user asked `welkin view` for.
struct ViewOptions {
  std::string scene = "spheres";     ///< a file or a built-in scene
  std::string environment = "sky:";  ///< a file or a sky
  TechniqueChoice technique, against;
  std::string reference_file;  ///< a stored truth for the first view; empty: it is traced
  ReferenceKind reference = ReferenceKind::truth;
  Comparison comparison = Comparison::picture;
  int width = 1280, height = 800;
  int map_size = 128;
  unsigned truth_samples = 4096;
  int threads = 0;  ///< 0: all cores
  float rotation_degrees = 0;
  std::optional<float> exposure_ev;
  ToneCurve curve = ToneCurve::filmic;
  bool panel = true, help = false;
  int frames = 0;          ///< 0: until it is closed
  std::string screenshot;  ///< of the whole window, after `frames`
  int exit_code = -1;      ///< >= 0: everything is said, leave with it
};

/// Reads the command line; prints help or the one line that says what is wrong.
ViewOptions parse_view_options(int argc, char** argv);

}  // namespace welkin
