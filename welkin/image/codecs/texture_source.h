#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include <welkin/image/codecs/texture_surface.h>
#include <welkin/image/image.h>
#include <welkin/image/range_fit.h>

namespace welkin {

/// What cubes and flat images have in common for a texture writer. levels[k] holds all faces of level k, one after the
/// other, level 0 the largest; side lengths halve (rounded down) to 1 at least.
struct TextureSource {
  int width = 0, height = 0, faces = 1, channels = 3;
  std::vector<std::span<const float>> levels;

  SurfaceShape shape(std::size_t level) const {
    return {std::max(1, width >> level), std::max(1, height >> level), faces};
  }
};

/// Views into the cube or image, which must outlive the result. Throws Error when it is empty, has not 1 to 4 channels,
/// or its levels do not halve.
TextureSource texture_source(const CubeMips& cube);
TextureSource texture_source(const Image& image);

/// The one scale for all levels: `wanted`, which must be a power of two (else Error), or if it is 0 the one that
/// `policy` asks for.
double texture_scale(const TextureSource& source, PixelFormat format, RangePolicy policy, double wanted);

}  // namespace welkin
