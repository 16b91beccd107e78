#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace welkin {

/// An image for the eye: 8-bit sRGB-encoded RGB or gray, rows from the top, pixels.size() == width * height *
/// channels.
struct ByteImage {
  int width = 0;
  int height = 0;
  int channels = 3;
  std::vector<std::uint8_t> pixels;

  ByteImage() = default;
  /// A black image.
  ByteImage(int image_width, int image_height, int image_channels = 3)
      : width(image_width),
        height(image_height),
        channels(image_channels),
        pixels(static_cast<std::size_t>(image_width) * image_height * image_channels) {}

  std::uint8_t* at(int x, int y) {
    return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
  const std::uint8_t* at(int x, int y) const {
    return pixels.data() + (static_cast<std::size_t>(y) * width + x) * channels;
  }
};

}  // namespace welkin
