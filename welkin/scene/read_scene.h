#pragma once
#include <filesystem>
#include <string>

#include <welkin/scene/scene.h>

namespace welkin {

/// Reads a scene file: glTF 2.0 (JSON or GLB), PLY or OBJ, the first two told by their first bytes, OBJ by its ending.
/// Buffers, images and MTL files are looked for beside it. Throws Error naming the file for anything that is wrong.
Scene read_scene(const std::filesystem::path& path);

/// Whether the name ends as a scene file's does: .gltf, .glb, .obj or .ply, in any case.
bool is_scene_file(const std::filesystem::path& path);

/// What a user names: a scene file by its ending, or else a built-in scene (built_in.h).
Scene open_scene(const std::string& name);

}  // namespace welkin
