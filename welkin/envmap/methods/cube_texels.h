#pragma once
#include <functional>

#include <welkin/envmap/filter.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// A cube from a function of direction: `value` fills rgb[3] for the centre of each texel, in parallel; what it gives is multiplied by
/// target.scale. For the methods that treat every texel alike. progress, if any, is told the share done, in [0, 1], from
/// the calling thread.
Cube cube_from_directions(const FilterTarget& target,
                          const std::function<void(Vec3 direction, double* rgb)>& value,
                          const std::function<void(double)>& progress = {});

/// The edge of the cube that holds a map's texels at its equator: width / 4 rounded up to a power of two, at least 8 and at most 4096.
int matching_cube_size(const Image& equirect);

}  // namespace welkin
