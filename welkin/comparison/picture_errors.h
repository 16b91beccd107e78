#pragma once
#include <cstddef>

#include <welkin/comparison/truth.h>

namespace welkin {

/// How far a picture is from its truth. All of a channel's differences count, at the pixels that surfaces cover in full in
/// both pictures; elsewhere the two renderers cut silhouettes differently (triangles against the box of the pixel).
struct PictureErrors {
  std::size_t pixels = 0;       ///< compared
  std::size_t edge_pixels = 0;  ///< that a surface covers in part, or in one of the pictures only
  double truth_mean = 0;        ///< of the truth over what is compared, all channels
  double mean_absolute = 0;     ///< mean |difference| / truth_mean
  double bias = 0;              ///< mean difference / truth_mean
  double rms = 0;               ///< root mean square difference / root mean square of the truth
  double p99 = 0, largest = 0;  ///< of |difference|, the 99th percentile and the largest, / truth_mean
  double flip = 0;         ///< mean of perceptual_difference, both at the truth's automatic exposure, filmic
  double truth_noise = 0;  ///< what the truth's own standard error adds: its mean absolute value / truth_mean
  double edge_mean_absolute = 0;  ///< mean |difference| over edge pixels / truth_mean
};

/// `picture`: 4 channels, radiance and coverage, as Renderer::read_picture or a mean over samples of it gives. Throws
/// Error where the sizes differ and where no pixel is covered in full by surfaces in both.
PictureErrors compare_with_truth(const Image& picture, const TruthPicture& truth);

/// 1 channel: 1 for pixels that are compared, 0.5 for edge pixels, else 0.
Image compared_pixels(const Image& picture, const TruthPicture& truth);

/// The mean of each factor x factor block: of a picture that was drawn so many times as large, what the path tracer's box filter
/// gives. Width and height are multiples of factor >= 1.
Image mean_of_blocks(const Image& image, int factor);

}  // namespace welkin
