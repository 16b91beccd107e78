#pragma once
#include <array>
#include <vector>

#include <welkin/envmap/patch_quadrature.h>
#include <welkin/image/image.h>

namespace welkin {

/// A texel that outshines its map: what it has above the threshold, the rest staying in the map.
struct BrightTexel {
  int x = 0, y = 0;
  Vec3 direction;          ///< of its centre
  double solid_angle = 0;  ///< sr
  SpherePatch patch;
  std::array<double, 3> radiance{};  ///< the excess
  std::array<float, 3> rest{};       ///< what stays in the map
};

/// A map split in two: the map with the rest of each bright texel in its place, and their excess. Large maps are not
/// copied for it.
struct BrightSplit {
  const Image* map = nullptr;       ///< the whole one, someone else's
  std::vector<BrightTexel> texels;  ///< by rows, from left to right
  double threshold = 0;             ///< luminance above which a texel is split
  double mean = 0;                  ///< mean luminance of the whole map over the sphere
  double busy_flux = 0;             ///< integral of the residual's luminance above 4 * mean, over the sphere
};

struct BrightOptions {
  int max_texels = 64;  ///< the threshold rises until no more than these lie above it
  double threshold_over_mean = 16;
};

/// Finds the sun and the lamps. The excess of a texel keeps its colour: all channels are cut by the same factor, so
/// that luminance (Rec. 709) comes down to the threshold. equirect has 3 channels, finite and >= 0, and must outlive the
/// split.
BrightSplit split_bright_texels(const Image& equirect, const BrightOptions& options = {});

}  // namespace welkin
