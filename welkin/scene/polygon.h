#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <welkin/geometry/vec3f.h>

namespace welkin {

/// Cuts a polygon into triangles with its orientation: indices into `corners`, corners.size() - 2 of them. A fan for
/// triangles, convex polygons and those of more than 256 corners; else ears (Meisters 1975), in the plane of Newell's
/// normal. Polygons that cross themselves, or bend, give some triangles that cover them.
void triangulate(std::span<const Vec3f> corners, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace welkin
