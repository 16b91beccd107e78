#pragma once
#include <optional>
#include <string>
#include <vector>

#include <welkin/realtime/gl/headless_context.h>
#include <welkin/realtime/renderer.h>

#include "frame_options.h"

namespace welkin {

/// A renderer without a display, made ready for a picture.
struct FrameJob {
  HeadlessContext context;  ///< before everything that needs it
  TechniqueChoice choice;
  PictureSize size;  ///< of the picture; the renderer's is supersample times as large
  std::shared_ptr<const EnvironmentData> light;
  std::optional<Renderer> renderer;
  int frames = 1;
  std::vector<std::string> warnings;
};

/// Of techniques that refine.
inline constexpr int default_progressive_frames = 64;

/// Throws CLI::ValidationError for an option and Error for a file, or where there is no OpenGL driver.
std::unique_ptr<FrameJob> make_frame_job(const FrameCommand& command);

/// Draws all frames. 4 channels: radiance and the share of the pixel that shows a surface, means over the samples.
Image draw_picture(FrameJob& job, int supersample);

/// A pass of a frame and the median of its times; the last row is the whole frame.
struct FrameTime {
  std::string pass;
  int depth = 0;
  double milliseconds = 0;
};
/// Draws `frames` more.
std::vector<FrameTime> time_passes(FrameJob& job, int frames);

}  // namespace welkin
