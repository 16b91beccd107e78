#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string_view>

#include <welkin/image/byte_image.h>
#include <welkin/scene/file_resolver.h>
#include <welkin/scene/scene.h>

namespace welkin {

/// Pictures of 3 or 4 channels that are decoded already, by their index in the file's "images": a browser does that
/// itself.
using GltfPictures = std::map<int, ByteImage>;

/// Reads glTF 2.0, as JSON or GLB (docs/scenes.md has what of it). One mesh for every primitive, one instance for every
/// primitive of a node's mesh, in the order of the node tree, children after their parent. `resolve` gives external
/// buffers and images. Throws Error naming `name` for anything damaged, missing, out of range, compressed, or without a
/// triangle; memory that is taken stays below a multiple of the file's size. An image in `pictures` is not decoded from
/// the file.
Scene decode_gltf(std::span<const std::uint8_t> bytes, std::string_view name, const FileResolver& resolve,
                  const GltfPictures& pictures = {});

}  // namespace welkin
