#pragma once
#include <cstdint>
#include <span>

#include <welkin/image/image.h>

namespace welkin {

/// Fills the named texels (y * width + x, each once) of an equirectangular map from the texels around them: the
/// smoothest values that meet the surroundings, i.e. each filled texel is the mean of its four neighbours (Laplace's
/// equation on the grid, which closes across the seam and the poles), to 1e-4 of the largest surrounding value. So a
/// filled value lies between the smallest and the largest of the surroundings. Nothing is done when every texel of the
/// map is named. Cost: about texels * sqrt(texels) per channel.
void inpaint(Image& equirect, std::span<const std::uint32_t> texels);

}  // namespace welkin
