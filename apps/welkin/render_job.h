#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <welkin/pathtrace/picture.h>

#include "render_options.h"

namespace welkin {

/// Everything that a picture is made of. Not to be moved once `render` is made: it keeps pointers.
struct RenderJob {
  Scene scene;
  std::optional<EnvironmentSampler> environment;
  Camera camera;
  PictureOptions options;
  std::uint64_t fingerprint = 0;
  std::vector<std::string> warnings;
};

/// Reads the scene and the environment and picks the camera. Throws Error for what is wrong with a file, and
/// CLI::ValidationError for an option.
RenderJob make_render_job(const RenderCommand& command);

}  // namespace welkin
