#pragma once
#include <optional>
#include <string>
#include <vector>

#include <welkin/comparison/picture_errors.h>
#include <welkin/image/byte_image.h>
#include <welkin/image/tonemap.h>

#include "frame_picture.h"

// What `welkin frame --reference` measures and shows.

namespace welkin {

/// Throws CLI::ValidationError, before any work, for what --reference and --sheet cannot be.
void check_reference(const FrameCommand& command);

/// Renders the truth of what the job has drawn, or reads it. Throws Error for a file that does not fit, Stopped when a
/// signal came.
TruthPicture make_truth(const FrameCommand& command, const FrameJob& job);

/// "spheres-truth.png" of "spheres.png".
std::string beside_name(const std::string& output, const std::string& suffix);

/// Everything that is known of a picture.
struct FrameReport {
  std::string technique, truth, scene, output;
  PictureSize size;
  std::optional<PictureErrors> errors;
  std::vector<FrameTime> times;
};
void print_report(const FrameReport& report);
std::string report_json(const FrameReport& report);

/// The difference at `difference_scale` times the truth's mean, above a legend.
ByteImage draw_difference(const Image& picture, const TruthPicture& truth, const PictureErrors& errors);

/// Picture, truth and difference side by side under captions with the errors.
ByteImage draw_sheet(const FrameReport& report, const Image& picture, const TruthPicture& truth,
                     const ToneMapOptions& tone);

}  // namespace welkin
