#include <fmt/format.h>

#include <cmath>

#include <welkin/error.h>
#include <welkin/geometry/frame.h>
#include <welkin/scene/gltf_build.h>

namespace welkin {
namespace {

struct Walk {
  const GltfDocument& document;
  GltfStorage& storage;
  Scene& scene;
  std::vector<GltfPlacement> placements;
  std::size_t flattened = 0;

  void place_mesh(int mesh, const Affine& to_world) {
    const float volume = determinant(to_world);
    if (volume == 0)
      ++flattened;
    else
      placements.push_back({mesh, to_world});
  }
};

// Without the scale that a camera's or light's node may have: z is kept, y as near as can be.
Affine without_scale(const Affine& a, std::string_view name) {
  const auto unit = [&](Vec3f v) {
    const float size = length(v);
    if (!(size > 0 && std::isfinite(size)))
      throw Error(name, "a camera or light is in a node without volume");
    return (1 / size) * v;
  };
  const Vec3f z = unit(a.z), x = unit(cross(a.y, a.z));
  return {x, cross(z, x), z, a.origin};
}

void place_light(Walk& walk, int index, const Affine& to_world) {
  const Affine place = without_scale(to_world, walk.document.name);
  PunctualLight light = walk.document.lights[index];
  light.position = place.origin;
  light.direction = -place.z;
  walk.scene.lights.push_back(light);
}

void place_camera(Walk& walk, int index, const Affine& to_world) {
  Camera camera = walk.document.cameras[index];
  camera.to_world = without_scale(to_world, walk.document.name);
  walk.scene.cameras.push_back(camera);
}

Vec3f triple(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

void place_many(Walk& walk, const GltfNode& node, const Affine& to_world) {
  static const std::vector<float> none;
  const GltfInstancing& many = walk.document.instancings[node.instancing];
  const auto values = [&](int accessor, int components, const char* what) -> const std::vector<float>& {
    return accessor < 0 ? none : walk.storage.floats(accessor, components, what);
  };
  const std::vector<float>& translations = values(many.translation, 3, "TRANSLATION");
  const std::vector<float>& rotations = values(many.rotation, 4, "ROTATION");
  const std::vector<float>& scales = values(many.scale, 3, "SCALE");
  const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
  walk.storage.spend(16 * count);
  for (const auto& [list, size] : {std::pair{&translations, std::size_t{3}}, {&rotations, 4}, {&scales, 3}}) {
    if (!list->empty() && list->size() != count * size)
      throw Error(walk.document.name, "the attributes of EXT_mesh_gpu_instancing differ in length");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f t = translations.empty() ? Vec3f{0, 0, 0} : triple(translations, i);
    const Vec3f s = scales.empty() ? Vec3f{1, 1, 1} : triple(scales, i);
    const float* q = rotations.empty() ? nullptr : &rotations[4 * i];
    const Affine local =
        q == nullptr ? make_affine(t, {0, 0, 0}, 1, s) : make_affine(t, {q[0], q[1], q[2]}, q[3], s);
    walk.place_mesh(node.mesh, to_world * local);
  }
}

void visit(Walk& walk, const GltfNode& node, const Affine& to_world) {
  if (node.camera >= 0) place_camera(walk, node.camera, to_world);
  if (node.light >= 0) place_light(walk, node.light, to_world);
  if (node.mesh < 0) return;
  if (node.instancing >= 0)
    place_many(walk, node, to_world);
  else
    walk.place_mesh(node.mesh, to_world);
}

}  // namespace

// Depth first with a stack of its own: a chain of a million nodes must not use up the program's.
std::vector<GltfPlacement> place_gltf_nodes(const GltfDocument& document, GltfStorage& storage,
                                            Scene& scene) {
  struct Entry {
    int node;
    Affine parent;
  };
  Walk walk{document, storage, scene, {}, 0};
  std::vector<Entry> stack;
  std::vector<bool> visited(document.nodes.size());
  for (auto root = document.roots.rbegin(); root != document.roots.rend(); ++root)
    stack.push_back({*root, {}});
  while (!stack.empty()) {
    const Entry entry = stack.back();
    stack.pop_back();
    if (visited[entry.node])
      throw Error(document.name, fmt::format("node {} has two parents or is its own ancestor", entry.node));
    visited[entry.node] = true;
    const GltfNode& node = document.nodes[entry.node];
    const Affine to_world = entry.parent * node.to_parent;
    visit(walk, node, to_world);
    for (std::uint32_t i = node.child_count; i-- > 0;)
      stack.push_back({document.children[node.first_child + i], to_world});
  }
  storage.forget();
  if (walk.flattened > 0)
    scene.warnings.push_back(
        fmt::format("{} instances are flattened by their transform and left out", walk.flattened));
  return std::move(walk.placements);
}

}  // namespace welkin
