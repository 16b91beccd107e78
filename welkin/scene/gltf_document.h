#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <welkin/scene/scene.h>

// A glTF file as its JSON says it, types and indices checked, nothing loaded. An index of -1 means none.

namespace welkin {

struct GltfBuffer {
  std::optional<std::string> uri;
  std::uint64_t byte_length = 0;
};

struct GltfView {
  int buffer = 0;
  std::uint64_t offset = 0, length = 0;
  std::uint64_t stride = 0;  ///< 0: packed
};

struct GltfSparse {
  std::uint64_t count = 0;
  int index_view = 0, value_view = 0;
  std::uint64_t index_offset = 0, value_offset = 0;
  int index_type = 0;
};

struct GltfAccessor {
  int view = -1;
  std::uint64_t offset = 0, count = 0;
  int component_type = 0;  ///< 5120 to 5126
  int components = 0;      ///< 1 to 4; 0 for matrices
  bool normalized = false;
  std::optional<GltfSparse> sparse;
};

struct GltfImage {
  std::string name;
  std::optional<std::string> uri;
  int view = -1;
};

struct GltfSampler {
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  bool nearest = false;
};

struct GltfTexture {
  int image = -1, sampler = -1;
};

struct GltfPrimitive {
  int mode = 4, indices = -1, material = -1;
  int position = -1, normal = -1, tangent = -1;
  std::array<int, 2> texcoords{-1, -1};
};

struct GltfMesh {
  std::string name;
  std::vector<GltfPrimitive> primitives;
};

/// The accessors of EXT_mesh_gpu_instancing.
struct GltfInstancing {
  int translation = -1, rotation = -1, scale = -1;
};

struct GltfNode {
  int mesh = -1, camera = -1, light = -1;
  int instancing = -1;  ///< into GltfDocument::instancings
  std::uint32_t first_child = 0, child_count = 0;
  Affine to_parent;
};

struct GltfDocument {
  std::string name;  ///< of the file, for messages
  std::vector<GltfBuffer> buffers;
  std::vector<GltfView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfImage> images;
  std::vector<GltfSampler> samplers;
  std::vector<GltfTexture> textures;
  std::vector<Material> materials;  ///< TextureUse::texture is an index into textures
  std::vector<GltfMesh> meshes;
  std::vector<Camera> cameras;  ///< to_world not yet known
  std::vector<PunctualLight> lights;
  std::vector<GltfInstancing> instancings;
  std::vector<GltfNode> nodes;
  std::vector<int> children;  ///< of all nodes
  std::vector<int> roots;     ///< of the scene that is shown
  std::vector<std::string> warnings;
};

/// Throws Error(name, ...) for what is not glTF 2.0, needs an extension that is not known, or refers to what is not there.
GltfDocument parse_gltf(std::string_view json, std::string_view name);

}  // namespace welkin
