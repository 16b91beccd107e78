#pragma once
#include <array>
#include <vector>

#include <welkin/image/image.h>

namespace welkin {

/// What texels are picked by: row_factor[y] times the weighted sum of the channels. 0 only for a black texel.
struct TexelWeights {
  const Image& map;                                          ///< 3 channels, finite, >= 0, and 0 or >= 1e-25
  std::array<float, 3> channels{0.2126f, 0.7152f, 0.0722f};  ///< each > 0
  std::vector<double> row_factor;

  double operator()(int x, int y) const {
    const float* texel = map.at(x, y);
    return row_factor[y] *
           (double{channels[0]} * texel[0] + double{channels[1]} * texel[1] + double{channels[2]} * texel[2]);
  }
};

}  // namespace welkin
