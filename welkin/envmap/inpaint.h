#pragma once
#include <cstdint>
#include <span>

#include <welkin/image/image.h>

namespace welkin {

/// Fills the named texels (y * width + x, each once) of an equirectangular map of 3 channels from the texels around
/// them: the smoothest values that meet the surroundings, i.e. each filled texel is the mean of its four neighbours
/// (Laplace's equation on the grid, which closes across the seam and, where the width is even, across the poles), to
/// 1e-4 of the largest surrounding value. A filled value lies between the smallest and the largest of the surroundings.
/// Nothing is done when every texel of the map is named. Time and memory are proportional to the number of texels,
/// sorting aside: about 2 s and 250 bytes per million.
void inpaint(Image& equirect, std::span<const std::uint32_t> texels);

}  // namespace welkin
