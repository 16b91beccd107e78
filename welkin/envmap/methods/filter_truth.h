#pragma once
#include <cstdint>
#include <vector>

#include <welkin/envmap/filter.h>

namespace welkin {

/// Brute force at some texels of a target, made once and compared with many methods.
struct FilterTruth {
  struct Texel {
    int face, x, y;
  };
  std::vector<Texel> texels;   ///< first those anywhere, then those about the map's brightest texel
  std::size_t anywhere = 0;    ///< how many are the former
  std::vector<double> values;  ///< [texel * 3 + channel], target.scale included
  double mean = 0;             ///< the filtered map's mean luminance over the sphere
  double seconds = 0;          ///< that the values took
};

/// All texels where a cube has no more than `count`, else so many at random and half as many among the 9 x 9 about the
/// map's brightest direction, where errors are largest. radiance has 3 channels.
FilterTruth make_filter_truth(const Image& radiance, const FilterTarget& target, int count = 64,
                              std::uint32_t seed = 1);

struct FilterErrors {
  double relative_rms = 0;  ///< RMS of the error over RMS of the truth, at the texels anywhere
  double max_over_mean =
      0;  ///< largest error of a channel at any of the texels, over the mean; 0 for a black map
  double edge_step = 0;  ///< see edge_step_ratio (cube_steps.h)
};

FilterErrors compare_with_truth(const Cube& cube, const FilterTruth& truth);

}  // namespace welkin
