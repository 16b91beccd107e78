#pragma once
#include <cstdint>
#include <vector>

#include <welkin/sphere/vec3.h>

namespace welkin {

/// `count` unit directions, spread evenly and uniformly over the sphere (each with weight 4 pi / count in an
/// integral). The same for the same (count, seed) everywhere; a smaller count is a prefix of a larger one. Points
/// are the R2 sequence mapped by the equal-area map of Archimedes, y = 1 - 2 v, phi = 2 pi u.
std::vector<Vec3> sphere_points(int count, std::uint64_t seed = 0);

}  // namespace welkin
