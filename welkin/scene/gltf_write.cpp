#include <welkin/scene/gltf_write.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <welkin/scene/shapes.h>

namespace welkin {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return out + "\"";
}

void append(std::string& list, const std::string& item) { list += (list.empty() ? "" : ",\n") + item; }

Mesh make_unit_sphere() {
  std::vector<OutlinePoint> outline;
  constexpr int rows = 128;
  for (int i = 0; i <= rows; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / rows - 0.5);
    const bool pole = i == 0 || i == rows;
    const Vec2f normal{pole ? 0.0f : static_cast<float>(std::cos(angle)),
                       static_cast<float>(std::sin(angle))};
    outline.push_back({normal, normal});
  }
  Mesh mesh = make_lathe(outline, 2 * rows);
  mesh.name = "sphere";
  return mesh;
}

struct Surface {
  float metallic, roughness, ior;
};

Surface nearest_surface(const Material& m) {
  switch (m.model) {
    case MaterialModel::metallic_roughness: return {m.metallic, m.perceptual_roughness, m.ior};
    case MaterialModel::lambert:
    case MaterialModel::oren_nayar: return {0, 1, 1};
    case MaterialModel::dielectric:
    case MaterialModel::coated_diffuse: return {0, m.perceptual_roughness, m.ior};
    case MaterialModel::mirror:
    case MaterialModel::conductor: return {1, 0, m.ior};
    default: return {1, m.perceptual_roughness, m.ior};
  }
}

std::string material_json(const Material& m) {
  const Surface surface = nearest_surface(m);
  const float strength = std::max(1.0f, max_channel(m.emission));
  const Rgb glow = (1 / strength) * m.emission;
  return fmt::format(
      R"({{"name":{},"pbrMetallicRoughness":{{"baseColorFactor":[{},{},{},1],"metallicFactor":{},"roughnessFactor":{}}},)"
      R"("emissiveFactor":[{},{},{}],"doubleSided":{},"extensions":{{"KHR_materials_ior":{{"ior":{}}},)"
      R"("KHR_materials_emissive_strength":{{"emissiveStrength":{}}}}}}})",
      quoted(m.name), std::min(m.base_color.r, 1.0f), std::min(m.base_color.g, 1.0f),
      std::min(m.base_color.b, 1.0f), surface.metallic, surface.roughness, glow.r, glow.g, glow.b,
      m.double_sided, surface.ior, strength);
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {}

  std::vector<std::uint8_t> run() {
    for (const Material& material : scene_.materials) append(materials_, material_json(material));
    for (const Mesh& mesh : scene_.meshes) add_mesh_json(mesh.name, add_primitive(mesh), mesh.material);
    for (const Instance& instance : scene_.instances) add_node("mesh", instance.mesh, instance.to_world);
    add_spheres();
    add_cameras();
    return assemble();
  }

 private:
  // Returns the index of the accessor.
  template <class Value>
  int add_accessor(const std::vector<Value>& values, int component_type, const char* type, std::size_t count,
                   const std::string& more = {}) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    const std::size_t offset = binary_.size(), size = values.size() * sizeof(Value);
    binary_.insert(binary_.end(), bytes, bytes + size);
    append(views_, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}}})", offset, size));
    append(accessors_, fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})",
                                   accessor_count_, component_type, count, type, more));
    return accessor_count_++;
  }

  // The attributes and indices of a mesh, as JSON.
  std::string add_primitive(const Mesh& mesh) {
    Vec3f low = mesh.positions.front(), high = low;
    for (const Vec3f& p : mesh.positions) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const std::size_t count = mesh.positions.size();
    std::string json = fmt::format(R"("attributes":{{"POSITION":{})",
                                   add_accessor(mesh.positions, 5126, "VEC3", count,
                                                fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", low.x,
                                                            low.y, low.z, high.x, high.y, high.z)));
    if (!mesh.normals.empty())
      json += fmt::format(R"(,"NORMAL":{})", add_accessor(mesh.normals, 5126, "VEC3", count));
    if (!mesh.texcoords[0].empty())
      json += fmt::format(R"(,"TEXCOORD_0":{})", add_accessor(mesh.texcoords[0], 5126, "VEC2", count));
    return json + fmt::format(R"(}},"indices":{})",
                              add_accessor(mesh.triangles, 5125, "SCALAR", 3 * mesh.triangles.size()));
  }

  int add_mesh_json(const std::string& name, const std::string& primitive, int material) {
    append(meshes_, fmt::format(R"({{"name":{},"primitives":[{{{},"material":{}}}]}})", quoted(name),
                                primitive, material));
    return mesh_count_++;
  }

  void add_node(const char* what, int index, const Affine& a) {
    append(nodes_, fmt::format(R"({{"{}":{},"matrix":[{},{},{},0,{},{},{},0,{},{},{},0,{},{},{},1]}})", what,
                               index, a.x.x, a.x.y, a.x.z, a.y.x, a.y.y, a.y.z, a.z.x, a.z.y, a.z.z,
                               a.origin.x, a.origin.y, a.origin.z));
    append(roots_, std::to_string(node_count_++));
  }

  void add_spheres() {
    if (scene_.spheres.empty()) return;
    const std::string primitive = add_primitive(make_unit_sphere());
    std::map<int, int> mesh_of;  // by material
    for (const Sphere& sphere : scene_.spheres) {
      const auto [entry, is_new] = mesh_of.try_emplace(sphere.material, 0);
      if (is_new) entry->second = add_mesh_json("sphere", primitive, sphere.material);
      const float r = sphere.radius;
      add_node("mesh", entry->second, {{r, 0, 0}, {0, r, 0}, {0, 0, r}, sphere.centre});
    }
  }

  void add_cameras() {
    int index = 0;
    for (const Camera& camera : scene_.cameras) {
      const float aspect = camera.width_over_height.value_or(1),
                  up = camera.orthographic_height.value_or(2) / 2;
      append(
          cameras_,
          camera.orthographic_height
              ? fmt::format(
                    R"({{"name":{},"type":"orthographic","orthographic":{{"xmag":{},"ymag":{},"znear":0.01,"zfar":1e6}}}})",
                    quoted(camera.name), up * aspect, up)
              : fmt::format(
                    R"({{"name":{},"type":"perspective","perspective":{{"yfov":{},"aspectRatio":{},"znear":0.01}}}})",
                    quoted(camera.name), camera.vertical_field_radians, aspect));
      add_node("camera", index++, camera.to_world);
    }
  }

  std::vector<std::uint8_t> assemble() {
    while (binary_.size() % 4 != 0) binary_.push_back(0);
    std::string json =
        R"({"asset":{"version":"2.0","generator":"welkin"},"extensionsUsed":["KHR_materials_ior","KHR_materials_emissive_strength"],"scene":0,)" +
        fmt::format(R"("scenes":[{{"nodes":[{}]}}])", roots_);
    const std::pair<const char*, std::string*> parts[] = {
        {"nodes", &nodes_},     {"meshes", &meshes_},       {"materials", &materials_},
        {"cameras", &cameras_}, {"accessors", &accessors_}, {"bufferViews", &views_}};
    for (const auto& [key, list] : parts) {
      if (!list->empty()) json += fmt::format(R"(,"{}":[{}])", key, *list);
    }
    json += fmt::format(R"(,"buffers":[{{"byteLength":{}}}]}})", binary_.size());
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<std::uint8_t> file;
    const auto number = [&file](std::size_t value) {
      for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<std::uint8_t>(value >> shift));
    };
    for (std::size_t value : {std::size_t{0x46546c67}, std::size_t{2}, 28 + json.size() + binary_.size(),
                              json.size(), std::size_t{0x4e4f534a}})
      number(value);
    file.insert(file.end(), json.begin(), json.end());
    number(binary_.size());
    number(0x004e4942);
    file.insert(file.end(), binary_.begin(), binary_.end());
    return file;
  }

  const Scene& scene_;
  std::vector<std::uint8_t> binary_;
  std::string views_, accessors_, meshes_, materials_, nodes_, roots_, cameras_;
  int accessor_count_ = 0, mesh_count_ = 0, node_count_ = 0;
};

}  // namespace

std::vector<std::uint8_t> encode_glb(const Scene& scene) { return Writer(scene).run(); }

}  // namespace welkin
