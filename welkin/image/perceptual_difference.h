#pragma once
#include <welkin/image/byte_image.h>
#include <welkin/image/image.h>

namespace welkin {

struct PerceptualOptions {
  /// How many pixels a degree of sight has; 67 is a 0.7 m wide display of 3840 pixels seen from 0.7 m.
  double pixels_per_degree = 67;
};

struct PerceptualDifference {
  Image map;  ///< 1 channel, 0 (no difference is seen) to 1 (as black and white)
  double mean = 0, median = 0, largest = 0;
};

/// How different two pictures look when one is flipped with the other on a display, after FLIP (Andersson, Nilsson,
/// Akenine-Moller, Oskarsson, Astrom & Fairchild 2020, "FLIP: A difference evaluator for alternating images"): colours
/// are filtered by the eye's contrast sensitivity at that distance, compared in a perceptually uniform space by a metric
/// for large differences, and made stronger where edges or points differ. Our own implementation of the published
/// equations and constants; not the authors' program, and no digit of theirs is promised.
/// a, b: linear Rec. 709 as the display shows it, 3 channels; values are clamped to [0, 1]. Sizes are equal by the
/// caller's duty. Symmetric.
PerceptualDifference perceptual_difference(const Image& a, const Image& b,
                                           const PerceptualOptions& options = {});

/// The map in colours of even lightness: black 0, through purple and orange, to near white 1.
ByteImage perceptual_map_image(const Image& map);

}  // namespace welkin
