#include <welkin/scene/obj.h>

#include <map>
#include <unordered_map>
#include <utility>

#include <welkin/error.h>
#include <welkin/scene/mesh_repair.h>
#include <welkin/scene/obj_faces.h>
#include <welkin/scene/polygon.h>

namespace welkin {
namespace {

// Corners that are one vertex of a mesh: the same position and texture coordinate, and the same normal or, without one,
// the same smoothing group.
struct VertexKey {
  std::int32_t position, texcoord, normal, group;
  bool operator==(const VertexKey&) const = default;
};

struct HashKey {
  std::size_t operator()(const VertexKey& key) const {
    std::uint64_t h = static_cast<std::uint32_t>(key.position);
    for (std::int32_t part : {key.texcoord, key.normal, key.group})
      h = (h ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15u, h ^= h >> 29;
    return h;
  }
};

std::uint64_t group_key(std::int32_t position, std::int32_t group) {
  return std::uint64_t{static_cast<std::uint32_t>(position)} << 32 | static_cast<std::uint32_t>(group);
}

class Builder {
 public:
  Builder(const ObjFile& file, Scene& scene) : file_(file), scene_(scene) {}

  void run() {
    sum_smooth_normals();
    for (std::size_t face = 0; face < file_.faces.size(); ++face) add_face(face);
    for (Draft& draft : drafts_) finish(draft);
    repairs_.add_warnings(scene_.warnings);
  }

 private:
  struct Draft {
    Mesh mesh;
    std::unordered_map<VertexKey, std::uint32_t, HashKey> vertices;
    bool has_texcoords = false, has_normals = false;
  };

  std::span<const ObjCorner> corners_of(std::size_t face) const {
    const std::size_t first = file_.faces[face].first;
    const std::size_t end =
        face + 1 < file_.faces.size() ? file_.faces[face + 1].first : file_.corners.size();
    return std::span(file_.corners).subspan(first, end - first);
  }

  void triangulate_face(std::span<const ObjCorner> corners) {
    positions_.clear();
    triangles_.clear();
    for (const ObjCorner& corner : corners) positions_.push_back(file_.positions[corner.position]);
    triangulate(positions_, triangles_);
  }

  Vec3f area_vector(const std::array<std::uint32_t, 3>& t) const {
    return cross(positions_[t[1]] - positions_[t[0]], positions_[t[2]] - positions_[t[0]]);
  }

  // The normals of a group at a position: the sum of its triangles' normals there, each by its area.
  void sum_smooth_normals() {
    for (std::size_t face = 0; face < file_.faces.size(); ++face) {
      const std::int32_t group = file_.faces[face].smoothing_group;
      if (group == 0) continue;
      const std::span<const ObjCorner> corners = corners_of(face);
      triangulate_face(corners);
      for (const auto& t : triangles_) {
        for (std::uint32_t i : t) {
          Vec3f& sum = smooth_[group_key(corners[i].position, group)];
          sum = sum + area_vector(t);
        }
      }
    }
  }

  Draft& draft_for(const ObjFace& face) {
    const auto [entry, is_new] = draft_of_.try_emplace({face.object, face.material}, drafts_.size());
    if (!is_new) return drafts_[entry->second];
    drafts_.emplace_back();
    drafts_.back().mesh.name = file_.objects[face.object];
    drafts_.back().mesh.material = face.material >= 0 ? face.material : default_material();
    return drafts_.back();
  }

  int default_material() {
    if (default_material_ < 0) {
      default_material_ = static_cast<int>(scene_.materials.size());
      scene_.materials.push_back(default_import_material());
    }
    return default_material_;
  }

  // Flat corners, with neither normal nor group, share a vertex only within their face, whose number stands in `group`.
  std::uint32_t vertex(Draft& draft, const ObjCorner& corner, std::size_t face, Vec3f flat_normal) {
    const std::int32_t group = file_.faces[face].smoothing_group;
    const bool is_flat = corner.normal < 0 && group == 0;
    const VertexKey key{corner.position, corner.texcoord, is_flat ? -2 : corner.normal,
                        is_flat             ? static_cast<std::int32_t>(face)
                        : corner.normal < 0 ? group
                                            : 0};
    Mesh& mesh = draft.mesh;
    const auto [entry, is_new] =
        draft.vertices.try_emplace(key, static_cast<std::uint32_t>(mesh.positions.size()));
    if (!is_new) return entry->second;
    mesh.positions.push_back(file_.positions[corner.position]);
    mesh.texcoords[0].push_back(corner.texcoord < 0 ? Vec2f{} : file_.texcoords[corner.texcoord]);
    mesh.normals.push_back(corner.normal >= 0 ? file_.normals[corner.normal]
                           : is_flat          ? flat_normal
                                              : smooth_[group_key(corner.position, group)]);
    draft.has_texcoords = draft.has_texcoords || corner.texcoord >= 0;
    draft.has_normals = draft.has_normals || !is_flat;
    return entry->second;
  }

  void add_face(std::size_t face) {
    const std::span<const ObjCorner> corners = corners_of(face);
    triangulate_face(corners);
    Draft& draft = draft_for(file_.faces[face]);
    Vec3f flat_normal;
    for (const auto& t : triangles_) flat_normal = flat_normal + area_vector(t);
    for (const auto& t : triangles_) {
      draft.mesh.triangles.push_back({vertex(draft, corners[t[0]], face, flat_normal),
                                      vertex(draft, corners[t[1]], face, flat_normal),
                                      vertex(draft, corners[t[2]], face, flat_normal)});
    }
  }

  void finish(Draft& draft) {
    Mesh& mesh = draft.mesh;
    draft.vertices = {};
    if (!draft.has_texcoords) mesh.texcoords[0].clear();
    if (!draft.has_normals) mesh.normals.clear();  // flat all over, which is what a mesh without them is
    repair_mesh(mesh, repairs_);
    if (mesh.triangles.empty()) return;
    if (scene_.materials[mesh.material].normal_texture.texture >= 0) make_tangents(mesh, 0);
    scene_.instances.push_back({static_cast<int>(scene_.meshes.size()), {}});
    scene_.meshes.push_back(std::move(mesh));
  }

  const ObjFile& file_;
  Scene& scene_;
  std::vector<Draft> drafts_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> draft_of_;
  std::unordered_map<std::uint64_t, Vec3f> smooth_;
  std::vector<Vec3f> positions_;                         // of the face in hand
  std::vector<std::array<std::uint32_t, 3>> triangles_;  // of the face in hand
  MeshRepairs repairs_;
  int default_material_ = -1;
};

}  // namespace

Scene decode_obj(std::span<const std::uint8_t> bytes, std::string_view name, const FileResolver& resolve) {
  Scene scene;
  scene.source = name;
  const ObjFile file =
      parse_obj({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, resolve, scene);
  if (file.positions.empty()) throw Error(name, "has no vertices: not an OBJ file, or an empty one");
  Builder(file, scene).run();
  if (scene.meshes.empty()) throw Error(name, "has no triangles to show");
  check_scene(scene);
  return scene;
}

}  // namespace welkin
