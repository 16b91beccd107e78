#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include <welkin/scene/scene.h>

namespace welkin {

/// Reads a PLY file (1.0; ascii and binary of either order): one mesh of its vertices (x y z, nx ny nz, and u v, s t or
/// texture_u texture_v) and its faces (vertex_indices or vertex_index: polygons) or tristrips. Without normals it is
/// flat. Everything else in it is skipped, colours with a warning. Throws Error naming `name` for what is damaged, cut
/// off or out of range, and without a triangle.
Scene decode_ply(std::span<const std::uint8_t> bytes, std::string_view name);

}  // namespace welkin
