#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include <welkin/scene/file_resolver.h>
#include <welkin/scene/scene.h>

namespace welkin {

/// Reads a Wavefront OBJ file with its MTL files, which `resolve` gives (docs/scenes.md has what of it). One mesh for
/// each object (o) and material, each with one instance. Vertices without vn are flat, or smooth within their smoothing
/// group. Throws Error(name, "line N: ...") for what is damaged or out of range, and without a triangle.
Scene decode_obj(std::span<const std::uint8_t> bytes, std::string_view name, const FileResolver& resolve);

}  // namespace welkin
