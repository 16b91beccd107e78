#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include <welkin/error.h>
#include <welkin/scene/gltf_fields.h>
#include <welkin/scene/text_lines.h>

namespace welkin {
namespace {

constexpr std::string_view known_extensions[] = {
    "KHR_texture_transform", "KHR_materials_ior",     "KHR_materials_emissive_strength",
    "KHR_lights_punctual",   "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
};
// Said in a warning, and the rest of the file is taken without them.
constexpr std::string_view ignored_extensions[] = {
    "KHR_materials_unlit",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_clearcoat",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_iridescence",
    "KHR_materials_anisotropy",
    "KHR_materials_dispersion",
    "KHR_materials_diffuse_transmission",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_variants",
    "KHR_animation_pointer",
    "KHR_xmp_json_ld",
};

template <std::size_t Size>
bool has(const std::string_view (&list)[Size], std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

void check_extensions(const GltfObject& root, GltfDocument& document) {
  const JsonView required = root.json.find("extensionsRequired"), used = root.json.find("extensionsUsed");
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string_view name = required.at(i).text().value_or("?");
    if (!has(known_extensions, name) && !has(ignored_extensions, name))
      root.fail(fmt::format("needs the extension {}, which welkin does not read", printable(name)));
  }
  std::string ignored;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::string_view name = used.at(i).text().value_or("?");
    if (has(known_extensions, name) || ignored.size() > 200) continue;
    ignored += (ignored.empty() ? "" : ", ") + printable(name);
  }
  if (!ignored.empty()) document.warnings.push_back("extensions that are not used: " + ignored);
}

void parse_accessor(const GltfObject& object, GltfDocument& document) {
  static constexpr std::string_view types[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  GltfAccessor accessor;
  const std::string type = object.text("type");
  const auto found = std::find(std::begin(types), std::end(types), type);
  if (found == std::end(types)) object.fail("its type is none of SCALAR, VEC2, ... MAT4");
  const auto place = static_cast<int>(found - std::begin(types));
  accessor.components = place < 4 ? place + 1 : 0;
  accessor.view = object.index_of("bufferView", document.views.size());
  accessor.offset = object.count("byteOffset", 0);
  accessor.count = object.count("count", 0);
  if (accessor.count > std::numeric_limits<std::uint32_t>::max()) object.fail("its count is above 2^32");
  accessor.component_type =
      static_cast<int>(std::min<std::uint64_t>(object.count("componentType", 0), 10000));
  accessor.normalized = object.boolean("normalized", false);
  if (const GltfObject sparse = object.part("sparse")) {
    const GltfObject indices = sparse.part("indices"), values = sparse.part("values");
    accessor.sparse = GltfSparse{
        .count = sparse.count("count", 0),
        .index_view = indices.required_index("bufferView", document.views.size()),
        .value_view = values.required_index("bufferView", document.views.size()),
        .index_offset = indices.count("byteOffset", 0),
        .value_offset = values.count("byteOffset", 0),
        .index_type = static_cast<int>(std::min<std::uint64_t>(indices.count("componentType", 0), 10000))};
  }
  document.accessors.push_back(accessor);
}

void note_unused(const GltfObject& object, const JsonView& attributes, GltfDocument& document) {
  const auto warn_once = [&document](std::string text) {
    if (std::find(document.warnings.begin(), document.warnings.end(), text) == document.warnings.end())
      document.warnings.push_back(std::move(text));
  };
  if (attributes.find("COLOR_0")) warn_once("vertex colors are not used");
  if (attributes.find("JOINTS_0")) warn_once("skins are not used: skinned meshes stand in their rest pose");
  if (object.json.find("targets").size() > 0) warn_once("morph targets are not used");
}

GltfPrimitive parse_primitive(const GltfObject& object, GltfDocument& document) {
  const GltfObject attributes = object.part("attributes");
  const std::size_t count = document.accessors.size();
  note_unused(object, attributes.json, document);
  return {.mode = static_cast<int>(std::min<std::uint64_t>(object.count("mode", 4), 100)),
          .indices = object.index_of("indices", count),
          .material = object.index_of("material", document.materials.size()),
          .position = attributes.index_of("POSITION", count),
          .normal = attributes.index_of("NORMAL", count),
          .tangent = attributes.index_of("TANGENT", count),
          .texcoords = {attributes.index_of("TEXCOORD_0", count), attributes.index_of("TEXCOORD_1", count)}};
}

void parse_meshes(const GltfObject& root, GltfDocument& document) {
  for_each_object(root, "meshes", "mesh", [&](const GltfObject& object) {
    GltfMesh mesh{object.text("name"), {}};
    for_each_object(object, "primitives", "primitive", [&](GltfObject primitive) {
      primitive.kind = "mesh", primitive.index = object.index;  // said of the mesh
      mesh.primitives.push_back(parse_primitive(primitive, document));
    });
    document.meshes.push_back(std::move(mesh));
  });
}

}  // namespace

void parse_gltf_storage(const GltfObject& root, GltfDocument& document) {
  for_each_object(root, "buffers", "buffer", [&](const GltfObject& object) {
    GltfBuffer buffer{std::nullopt, object.count("byteLength", 0)};
    if (object.json.find("uri")) buffer.uri = object.text("uri");
    document.buffers.push_back(std::move(buffer));
  });
  for_each_object(root, "bufferViews", "buffer view", [&](const GltfObject& object) {
    document.views.push_back({.buffer = object.required_index("buffer", document.buffers.size()),
                              .offset = object.count("byteOffset", 0),
                              .length = object.count("byteLength", 0),
                              .stride = object.count("byteStride", 0)});
    if (document.views.back().stride > 65536) object.fail("its byteStride is above 65536");
  });
  for_each_object(root, "accessors", "accessor",
                  [&](const GltfObject& object) { parse_accessor(object, document); });
}

GltfDocument parse_gltf(std::string_view json, std::string_view name) {
  const JsonDocument parsed(json, name);
  GltfDocument document;
  document.name = name;
  const GltfObject root{document.name, "", 0, parsed.root()};
  const std::string version = root.part("asset").text("version");
  if (version.empty()) root.fail("not glTF: it has no asset.version");
  if (version.substr(0, 2) != "2.")
    root.fail(fmt::format("glTF {} is not read, only 2.0", printable(version)));
  check_extensions(root, document);
  parse_gltf_storage(root, document);
  parse_gltf_materials(root, document);
  parse_meshes(root, document);
  parse_gltf_nodes(root, document);
  return document;
}

}  // namespace welkin
