#pragma once
#include <cstddef>
#include <vector>

// Pixels in memory: always float, linear, channels interleaved, row 0 at the top. What the numbers mean (radiance,
// irradiance, ...) is said by whoever holds the image; see docs/conventions.md.

namespace welkin {

/// A flat image. pixels.size() == width * height * channels; the pixel (x, y) starts at ((y * width) + x) * channels.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<float> pixels;

  Image() = default;
  /// A black image.
  Image(int image_width, int image_height, int image_channels = 3)
      : width(image_width),
        height(image_height),
        channels(image_channels),
        pixels(static_cast<std::size_t>(image_width) * image_height * image_channels) {}

  bool empty() const { return pixels.empty(); }
  float* at(int x, int y) { return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels; }
  const float* at(int x, int y) const {
    return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
};

/// Six square faces in the order +X -X +Y -Y +Z -Z with the OpenGL/KTX orientation (welkin/sphere/cube.h has the
/// directions). texels.size() == 6 * size * size * channels; face after face, each row by row from its top.
struct Cube {
  int size = 0;
  int channels = 3;
  std::vector<float> texels;

  Cube() = default;
  /// A black cube.
  explicit Cube(int face_size, int cube_channels = 3)
      : size(face_size),
        channels(cube_channels),
        texels(std::size_t{6} * face_size * face_size * cube_channels) {}

  bool empty() const { return texels.empty(); }
  float* at(int face, int x, int y) {
    return texels.data() + ((static_cast<std::size_t>(face) * size + y) * size + x) * channels;
  }
  const float* at(int face, int x, int y) const {
    return texels.data() + ((static_cast<std::size_t>(face) * size + y) * size + x) * channels;
  }
};

/// A cube map with mip levels: levels[0] is the largest; levels[k].size == max(1, levels[0].size >> k).
struct CubeMips {
  std::vector<Cube> levels;

  bool empty() const { return levels.empty(); }
  int size() const { return levels.empty() ? 0 : levels.front().size; }
  int channels() const { return levels.empty() ? 0 : levels.front().channels; }
};

}  // namespace welkin
