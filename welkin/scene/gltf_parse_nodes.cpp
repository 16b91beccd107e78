#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include <welkin/scene/gltf_fields.h>

namespace welkin {
namespace {

Camera parse_camera(const GltfObject& object) {
  Camera camera;
  camera.name = object.text("name");
  if (const GltfObject perspective = object.part("perspective")) {
    camera.vertical_field_radians = perspective.number("yfov", 0.7f);
    const float aspect = perspective.number("aspectRatio", 0);
    if (aspect > 0) camera.width_over_height = aspect;
  } else if (const GltfObject orthographic = object.part("orthographic")) {
    const float across = orthographic.number("xmag", 1), up = orthographic.number("ymag", 1);
    camera.orthographic_height = 2 * up;
    if (up > 0 && across > 0) camera.width_over_height = across / up;
  } else {
    object.fail("is neither perspective nor orthographic");
  }
  return camera;
}

PunctualLight parse_light(const GltfObject& object) {
  PunctualLight light;
  const std::string type = object.text("type");
  std::array<float, 3> color{1, 1, 1};
  object.numbers("color", color);
  light.intensity = object.number("intensity", 1) * Rgb{color[0], color[1], color[2]};
  if (type == "directional") {
    light.kind = PunctualLight::Kind::directional;
  } else if (type == "point") {
    light.kind = PunctualLight::Kind::point;
  } else if (type == "spot") {
    light.kind = PunctualLight::Kind::spot;
    const GltfObject spot = object.part("spot");
    light.inner_cone_radians = spot.number("innerConeAngle", 0);
    light.outer_cone_radians = spot.number("outerConeAngle", 0.7853982f);
  } else {
    object.fail("its type is none of directional, point, spot");
  }
  return light;
}

// A rotation of length 0 has no direction and counts as none.
Affine parse_transform(const GltfObject& object) {
  std::array<float, 16> m{};
  if (object.numbers("matrix", m))
    return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
  std::array<float, 3> t{0, 0, 0}, s{1, 1, 1};
  std::array<float, 4> q{0, 0, 0, 1};
  object.numbers("translation", t);
  object.numbers("scale", s);
  if (object.numbers("rotation", q)) {
    const float size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (size > 0 && std::isfinite(size)) {
      for (float& part : q) part /= size;
    } else {
      q = {0, 0, 0, 1};
    }
  }
  return make_affine({t[0], t[1], t[2]}, {q[0], q[1], q[2]}, q[3], {s[0], s[1], s[2]});
}

void add_children(const GltfObject& object, const JsonView& array, std::size_t node_count,
                  std::vector<int>& to) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    const std::optional<double> child = array.at(i).number();
    if (!child || !(*child >= 0 && *child < static_cast<double>(node_count)) || *child != std::floor(*child))
      object.fail(fmt::format("refers to a node that does not exist, there are {}", node_count));
    to.push_back(static_cast<int>(*child));
  }
}

GltfNode parse_node(const GltfObject& object, GltfDocument& document, std::size_t node_count) {
  GltfNode node;
  node.mesh = object.index_of("mesh", document.meshes.size());
  node.camera = object.index_of("camera", document.cameras.size());
  node.first_child = static_cast<std::uint32_t>(document.children.size());
  add_children(object, object.json.find("children"), node_count, document.children);
  node.child_count = static_cast<std::uint32_t>(document.children.size()) - node.first_child;
  node.to_parent = parse_transform(object);
  if (!object.json.find("extensions")) return node;
  node.light = object.extension("KHR_lights_punctual").index_of("light", document.lights.size());
  if (const GltfObject attributes = object.extension("EXT_mesh_gpu_instancing").part("attributes")) {
    const std::size_t count = document.accessors.size();
    node.instancing = static_cast<int>(document.instancings.size());
    document.instancings.push_back({attributes.index_of("TRANSLATION", count),
                                    attributes.index_of("ROTATION", count),
                                    attributes.index_of("SCALE", count)});
  }
  return node;
}

// Those of the default scene, or of the first; without scenes, all that are nobody's children.
std::vector<int> parse_roots(const GltfObject& root, const GltfDocument& document) {
  const JsonView scenes = root.json.find("scenes");
  std::vector<int> roots;
  if (scenes.size() > 0) {
    const int shown = std::max(0, root.index_of("scene", scenes.size()));
    const GltfObject scene{root.file, "scene", static_cast<std::size_t>(shown), scenes.at(shown)};
    add_children(scene, scene.json.find("nodes"), document.nodes.size(), roots);
    return roots;
  }
  std::vector<bool> has_parent(document.nodes.size());
  for (int child : document.children) has_parent[child] = true;
  for (std::size_t i = 0; i < has_parent.size(); ++i) {
    if (!has_parent[i]) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

}  // namespace

void parse_gltf_nodes(const GltfObject& root, GltfDocument& document) {
  for_each_object(root, "cameras", "camera",
                  [&](const GltfObject& object) { document.cameras.push_back(parse_camera(object)); });
  for_each_object(root.extension("KHR_lights_punctual"), "lights", "light",
                  [&](const GltfObject& object) { document.lights.push_back(parse_light(object)); });
  const std::size_t node_count = root.json.find("nodes").size();
  document.nodes.reserve(node_count);
  for_each_object(root, "nodes", "node", [&](const GltfObject& object) {
    document.nodes.push_back(parse_node(object, document, node_count));
  });
  document.roots = parse_roots(root, document);
}

}  // namespace welkin
