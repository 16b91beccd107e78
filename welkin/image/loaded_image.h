#pragma once
#include <string>
#include <vector>

#include <welkin/image/image.h>

namespace welkin {

/// What a reader found in a file: either a flat image or a cube map, never both. Always 3 channels (linear
/// Rec.709; alpha is dropped, gray is repeated), row 0 at the top, with what the file says about exposure
/// divided out.
struct LoadedImage {
  Image flat;     ///< empty when the file holds a cube
  CubeMips cube;  ///< empty when the file holds a flat image
  std::vector<std::string>
      warnings;        ///< one line each, without the file name: what was dropped, cropped, guessed
  std::string format;  ///< for people, e.g. "Radiance HDR", "OpenEXR", "KTX2 RGBA16F"
  /// true value = pixel * stored_scale. 1 from every reader of today: where a file names a scale that was divided out
  /// so that its format could hold the range, the reader multiplies it back in.
  double stored_scale = 1;

  bool is_cube() const { return !cube.empty(); }
};

}  // namespace welkin
