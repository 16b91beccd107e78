#include <welkin/scene/read_scene.h>

#include <string>

#include <welkin/error.h>
#include <welkin/image/file_extension.h>
#include <welkin/image/output_file.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/gltf.h>
#include <welkin/scene/obj.h>
#include <welkin/scene/ply.h>

namespace welkin {

Scene read_scene(const std::filesystem::path& path) {
  const std::string name = path.string(), extension = lower_case_extension(path);
  const std::vector<std::uint8_t> bytes = read_file(path);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("glTF") || extension == ".gltf" || extension == ".glb")
    return decode_gltf(bytes, name, resolve_beside(path));
  if (text.starts_with("ply\n") || text.starts_with("ply\r") || extension == ".ply")
    return decode_ply(bytes, name);
  if (extension == ".obj") return decode_obj(bytes, name, resolve_beside(path));
  throw Error(name, "not a scene that can be read (glTF 2.0, GLB, OBJ, PLY)");
}

bool is_scene_file(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj" || extension == ".ply";
}

Scene open_scene(const std::string& name) {
  return is_scene_file(name) ? read_scene(name) : make_built_in_scene(name);
}

}  // namespace welkin
