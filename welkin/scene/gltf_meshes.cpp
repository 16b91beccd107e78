#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>
#include <welkin/scene/gltf_build.h>

namespace welkin {
namespace {

using Indices = std::vector<std::uint32_t>;

// Strips and fans: glTF 2.0, 3.7.2.1. Strips join their pieces by triangles with equal corners, left out here.
void add_triangles(Mesh& mesh, const Indices& corners, int mode) {
  const std::size_t count = corners.size();
  if (mode == 4) {
    mesh.triangles.reserve(count / 3);
    for (std::size_t i = 0; i + 3 <= count; i += 3)
      mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return;
  }
  for (std::size_t i = 0; i + 3 <= count; ++i) {
    const std::size_t odd = i % 2;
    const std::uint32_t a = mode == 6 ? corners[0] : corners[i],
                        b = mode == 6 ? corners[i + 1] : corners[i + 1 + odd],
                        c = mode == 6 ? corners[i + 2] : corners[i + 2 - odd];
    if (a != b && b != c && c != a) mesh.triangles.push_back({a, b, c});
  }
}

Vec2f pair_at(const std::vector<float>& v, std::size_t i) { return {v[2 * i], v[2 * i + 1]}; }
Vec3f triple_at(const std::vector<float>& v, std::size_t i, std::size_t stride = 3) {
  return {v[stride * i], v[stride * i + 1], v[stride * i + 2]};
}

class MeshBuilder {
 public:
  MeshBuilder(const GltfDocument& document, GltfStorage& storage, Scene& scene)
      : document_(document), storage_(storage), scene_(scene) {}

  // Adds the triangles of a mesh to the scene: nothing for points, lines and empty primitives.
  void add(int index) {
    for (const GltfPrimitive& primitive : document_.meshes[index].primitives) {
      if (primitive.mode < 4 || primitive.mode > 6) {
        skipped_ = true;
        continue;
      }
      if (primitive.position < 0) fail(index, "a primitive has no POSITION");
      Mesh mesh = read(index, primitive);
      repair_mesh(mesh, repairs_);
      if (mesh.triangles.empty()) continue;
      if (scene_.materials[mesh.material].normal_texture.texture >= 0)
        make_tangents(mesh, scene_.materials[mesh.material].normal_texture.texcoord);
      scene_.meshes.push_back(std::move(mesh));
    }
  }

  void add_warnings() const {
    if (skipped_) scene_.warnings.emplace_back("points and lines are left out");
    repairs_.add_warnings(scene_.warnings);
  }

 private:
  [[noreturn]] void fail(int mesh, std::string_view what) const {
    throw Error(document_.name, fmt::format("mesh {}: {}", mesh, what));
  }

  int material_of(const GltfPrimitive& primitive) {
    if (primitive.material >= 0) return primitive.material;
    if (default_material_ < 0) {
      default_material_ = static_cast<int>(scene_.materials.size());
      scene_.materials.emplace_back();
      scene_.materials.back().name = "default";
    }
    return default_material_;
  }

  // The corners as indices into what is kept: vertices that are used, in the order of the file.
  Indices read_corners(int index, const GltfPrimitive& primitive, Indices& kept) {
    const std::uint64_t count = storage_.count(primitive.position);
    Indices corners;
    if (primitive.indices >= 0) {
      corners = storage_.indices(primitive.indices);
    } else {
      storage_.spend(count);
      corners.resize(count);
      for (std::uint32_t i = 0; i < count; ++i) corners[i] = i;
    }
    for (std::uint32_t corner : corners) {
      if (corner >= count) fail(index, fmt::format("a triangle uses vertex {} of {}", corner, count));
    }
    kept = corners;
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    const bool all = kept.size() == count;
    for (std::uint32_t& corner : corners) {
      if (!all)
        corner =
            static_cast<std::uint32_t>(std::lower_bound(kept.begin(), kept.end(), corner) - kept.begin());
    }
    return corners;
  }

  const std::vector<float>* attribute(int index, int accessor, int components, const char* what,
                                      std::uint64_t count) {
    if (accessor < 0) return nullptr;
    if (storage_.count(accessor) != count)
      fail(index, fmt::format("{} has {} values for {} positions", what, storage_.count(accessor), count));
    return &storage_.floats(accessor, components, what);
  }

  Mesh read(int index, const GltfPrimitive& primitive) {
    Mesh mesh;
    mesh.name = document_.meshes[index].name;
    mesh.material = material_of(primitive);
    Indices kept;
    const Indices corners = read_corners(index, primitive, kept);
    const std::uint64_t count = storage_.count(primitive.position);
    storage_.spend(12 * kept.size());
    const std::vector<float>& positions = storage_.floats(primitive.position, 3, "POSITION");
    for (std::uint32_t i : kept) mesh.positions.push_back(triple_at(positions, i));
    for (const Vec3f& p : mesh.positions) {
      if (!std::isfinite(p.x + p.y + p.z)) fail(index, "a position is not finite");
    }
    if (const auto* normals = attribute(index, primitive.normal, 3, "NORMAL", count)) {
      for (std::uint32_t i : kept) mesh.normals.push_back(triple_at(*normals, i));
    }
    if (const auto* tangents = attribute(index, primitive.tangent, 4, "TANGENT", count)) {
      for (std::uint32_t i : kept) {
        mesh.tangents.push_back(triple_at(*tangents, i, 4));
        mesh.tangent_signs.push_back((*tangents)[4 * std::size_t{i} + 3]);
      }
    }
    read_texcoords(index, primitive, kept, count, mesh);
    add_triangles(mesh, corners, primitive.mode);
    return mesh;
  }

  void read_texcoords(int index, const GltfPrimitive& primitive, const Indices& kept, std::uint64_t count,
                      Mesh& mesh) {
    for (int set = 0; set < 2; ++set) {
      const auto* values = attribute(index, primitive.texcoords[set], 2, "TEXCOORD", count);
      if (values == nullptr) continue;
      for (std::uint32_t i : kept) {
        const Vec2f uv = pair_at(*values, i);
        if (!std::isfinite(uv.x + uv.y)) fail(index, "a texture coordinate is not finite");
        mesh.texcoords[set].push_back(uv);
      }
    }
  }

  const GltfDocument& document_;
  GltfStorage& storage_;
  Scene& scene_;
  MeshRepairs repairs_;
  int default_material_ = -1;
  bool skipped_ = false;
};

}  // namespace

void build_gltf_meshes(const GltfDocument& document, GltfStorage& storage,
                       const std::vector<GltfPlacement>& placements, Scene& scene) {
  std::vector<std::pair<int, int>> ranges(document.meshes.size(), {-1, -1});  // of scene.meshes
  MeshBuilder builder(document, storage, scene);
  for (const GltfPlacement& placement : placements) {
    auto& [first, last] = ranges[placement.mesh];
    if (first < 0) {
      first = static_cast<int>(scene.meshes.size());
      builder.add(placement.mesh);
      last = static_cast<int>(scene.meshes.size());
    }
    storage.spend(static_cast<std::uint64_t>(last - first));
    for (int mesh = first; mesh < last; ++mesh) scene.instances.push_back({mesh, placement.to_world});
  }
  builder.add_warnings();
}

}  // namespace welkin
