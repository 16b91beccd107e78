#include <welkin/scene/gltf.h>

#include <fmt/format.h>

#include <cstring>

#include <welkin/error.h>
#include <welkin/scene/gltf_build.h>

namespace welkin {
namespace {

struct Chunks {
  std::string_view json;
  std::span<const std::uint8_t> binary;
};

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string_view text_of(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// glTF 2.0, 4.4: a header of 12 bytes, then chunks of length, type, data; JSON first, BIN second, others are skipped.
Chunks split_glb(std::span<const std::uint8_t> bytes, std::string_view name) {
  constexpr std::uint32_t json_type = 0x4e4f534a, binary_type = 0x004e4942;
  if (bytes.size() < 12) throw Error(name, "this GLB is cut off");
  if (number_at(bytes, 4) != 2)
    throw Error(name, fmt::format("GLB version {} is not read, only 2", number_at(bytes, 4)));
  if (number_at(bytes, 8) > bytes.size())
    throw Error(name,
                fmt::format("this GLB is cut off: it has {} of {} bytes", bytes.size(), number_at(bytes, 8)));
  std::span<const std::uint8_t> rest = bytes.first(number_at(bytes, 8));
  if (rest.size() < 12) throw Error(name, "this GLB is damaged: its length is below 12");
  rest = rest.subspan(12);
  Chunks chunks;
  for (int i = 0; rest.size() >= 8; ++i) {
    const std::uint32_t size = number_at(rest, 0), type = number_at(rest, 4);
    if (size > rest.size() - 8) throw Error(name, "this GLB is damaged: a chunk reaches beyond its end");
    const std::span<const std::uint8_t> data = rest.subspan(8, size);
    if (i == 0 && type == json_type) chunks.json = text_of(data);
    if (i == 1 && type == binary_type) chunks.binary = data;
    rest = rest.subspan(8 + size);
  }
  if (chunks.json.empty()) throw Error(name, "this GLB is damaged: it does not begin with JSON");
  return chunks;
}

}  // namespace

Scene decode_gltf(std::span<const std::uint8_t> bytes, std::string_view name, const FileResolver& resolve,
                  const GltfPictures& pictures) {
  const bool is_glb = text_of(bytes).substr(0, 4) == "glTF";
  const Chunks chunks = is_glb ? split_glb(bytes, name) : Chunks{text_of(bytes), {}};
  const GltfDocument document = parse_gltf(chunks.json, name);
  GltfStorage storage(document, chunks.binary, resolve, bytes.size());
  Scene scene;
  scene.source = name;
  scene.warnings = document.warnings;
  const std::vector<GltfPlacement> placements = place_gltf_nodes(document, storage, scene);
  build_gltf_materials(document, storage, pictures, scene);
  build_gltf_meshes(document, storage, placements, scene);
  if (scene.instances.empty()) throw Error(name, "has no triangles to show");
  check_scene(scene);
  return scene;
}

}  // namespace welkin
