#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/image/rgb.h>

// Differences of two pictures of radiance: as colours with their legend, and as numbers.

namespace welkin {

/// Colours at even steps of a scale; between two they are mixed. As shown: sRGB-encoded, 0 to 1. The shader takes these very
/// numbers.
inline constexpr int color_stops = 7;
using ColorScale = std::array<Rgb, color_stops>;

/// From -scale (blue) over 0 (black) to +scale (orange to white-yellow): a picture brighter than its reference is warm.
const ColorScale& signed_colors();
/// From 0 (black) through blue, purple, red, orange and yellow to white; lightness rises all the way.
const ColorScale& size_colors();

/// The colour at `position` in [0, 1] (clamped) of a scale.
Rgb false_color(const ColorScale& colors, float position);

/// The next of 1, 2, 5, 10, ... times a power of ten that is not below `value`; 1e-6 at least.
double nice_scale(double value);

struct LegendMark {
  float position = 0;  ///< in [0, 1] along the colours
  double value = 0;    ///< radiance
};
/// Five marks for a scale that ends at `scale`: -scale to scale, or 0 to scale.
std::vector<LegendMark> legend_marks(double scale, bool with_sign);

/// Of a picture minus its reference, in radiance, over the pixels that count: those where both show a surface (alpha 1) and every value
/// is finite.
struct DifferenceNumbers {
  std::size_t pixels = 0;   ///< that count
  std::size_t faults = 0;   ///< pixels that a value that is not finite keeps out
  double mean = 0;          ///< with sign, over the three channels
  double rms = 0;           ///< over the three channels
  double relative_rms = 0;  ///< rms over the root mean square of the reference; 0 where that is black
  double p99 = 0;           ///< 99 of 100 pixels differ by less, by their largest channel
  double largest = 0;
};

/// Both have one size; 4 channels, alpha 1 where there is a surface, or 3, which means a surface everywhere.
DifferenceNumbers measure_difference(const Image& picture, const Image& reference);

}  // namespace welkin
