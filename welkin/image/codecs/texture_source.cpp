#include <welkin/image/codecs/texture_source.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <welkin/error.h>

namespace welkin {
namespace {

void check_channels(int channels) {
  if (channels < 1 || channels > 4) throw Error("a texture must have 1 to 4 channels");
}

}  // namespace

TextureSource texture_source(const CubeMips& cube) {
  if (cube.empty() || cube.size() < 1) throw Error("cannot write an empty cube map");
  check_channels(cube.channels());
  TextureSource source{cube.size(), cube.size(), 6, cube.channels(), {}};
  for (std::size_t k = 0; k < cube.levels.size(); ++k) {
    const Cube& level = cube.levels[k];
    const bool after_the_last = k > 0 && cube.levels[k - 1].size == 1;
    const bool halves = k <= 30 && level.size == std::max(1, cube.size() >> k) && !after_the_last;
    if (!halves || level.channels != cube.channels()) {
      throw Error("the levels of a cube map must halve in size, down to 1 at most, with the same channels");
    }
    source.levels.emplace_back(level.texels);
  }
  return source;
}

TextureSource texture_source(const Image& image) {
  if (image.empty()) throw Error("cannot write an empty image");
  check_channels(image.channels);
  return {image.width, image.height, 1, image.channels, {image.pixels}};
}

double texture_scale(const TextureSource& source, PixelFormat format, RangePolicy policy, double wanted) {
  int exponent = 0;
  const bool power_of_two = wanted > 0 && std::isfinite(wanted) && std::frexp(wanted, &exponent) == 0.5 &&
                            std::abs(exponent) <= 125;
  if (power_of_two) return wanted;
  if (wanted != 0) throw Error("the stored scale must be a power of two");
  float largest = 0;
  for (const auto level : source.levels) largest = std::max(largest, largest_storable(level, format));
  return scale_for(largest, format, policy);
}

}  // namespace welkin
