#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <welkin/pathtrace/image_based.h>
#include <welkin/pathtrace/picture.h>

#include "render_options.h"

namespace welkin {

/// Everything that a picture is made of. Not to be moved once `render` is made: it keeps pointers.
struct RenderJob {
  Scene scene;
  std::optional<EnvironmentSampler> environment;
  std::unique_ptr<ImageBasedLight> image_based;  ///< of the environment, for --integrator ibl
  Camera camera;
  PictureOptions options;
  std::uint64_t fingerprint = 0;
  std::vector<std::string> warnings;
};

/// Reads the scene and the environment and picks the camera. Throws Error for what is wrong with a file, and
/// CLI::ValidationError for an option.
RenderJob make_render_job(const RenderCommand& command);

}  // namespace welkin
