#include <welkin/scene/mesh_repair.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <welkin/geometry/frame.h>

namespace welkin {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// In double: the squares of edges of 1e-15 metres are not lost. Not of unit length; 0 for a triangle without area.
std::array<double, 3> area_vector(const Mesh& mesh, const Triangle& t) {
  const Vec3f p = mesh.positions[t[0]], q = mesh.positions[t[1]], r = mesh.positions[t[2]];
  const double ax = double{q.x} - p.x, ay = double{q.y} - p.y, az = double{q.z} - p.z;
  const double bx = double{r.x} - p.x, by = double{r.y} - p.y, bz = double{r.z} - p.z;
  return {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx};
}

bool is_flat(const Mesh& mesh, const Triangle& t) {
  const auto n = area_vector(mesh, t);
  return n[0] == 0 && n[1] == 0 && n[2] == 0;
}

// Unit length; false for what has no direction.
bool normalise(Vec3f& v) {
  const double size = std::sqrt(double{v.x} * v.x + double{v.y} * v.y + double{v.z} * v.z);
  if (!(size > 1e-20 && size < 1e30)) return false;
  v = {static_cast<float>(v.x / size), static_cast<float>(v.y / size), static_cast<float>(v.z / size)};
  return true;
}

void repair_normals(Mesh& mesh, MeshRepairs& repairs) {
  std::vector<bool> bad(mesh.normals.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    bad[i] = !normalise(mesh.normals[i]);
    count += bad[i] ? 1 : 0;
    if (bad[i]) mesh.normals[i] = {0, 0, 1};
  }
  if (count == 0) return;
  repairs.bad_normals += count;
  for (const Triangle& t : mesh.triangles) {
    const auto n = area_vector(mesh, t);
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(size > 0)) continue;
    const Vec3f normal{static_cast<float>(n[0] / size), static_cast<float>(n[1] / size),
                       static_cast<float>(n[2] / size)};
    for (std::uint32_t i : t) {
      if (bad[i]) mesh.normals[i] = normal;
    }
  }
}

void repair_tangents(Mesh& mesh, MeshRepairs& repairs) {
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    mesh.tangent_signs[i] = mesh.tangent_signs[i] < 0 ? -1.0f : 1.0f;
    if (normalise(mesh.tangents[i])) continue;
    ++repairs.bad_tangents;
    mesh.tangents[i] = make_frame(mesh.normals.empty() ? Vec3f{0, 0, 1} : mesh.normals[i]).tangent;
  }
}

std::uint32_t double_vertex(Mesh& mesh, std::uint32_t i) {
  mesh.positions.push_back(Vec3f(mesh.positions[i]));
  if (!mesh.normals.empty()) mesh.normals.push_back(Vec3f(mesh.normals[i]));
  for (auto& texcoords : mesh.texcoords) {
    if (!texcoords.empty()) texcoords.push_back(Vec2f(texcoords[i]));
  }
  return static_cast<std::uint32_t>(mesh.positions.size()) - 1;
}

// Twice the area of a triangle in the texture, > 0 where (u, 1 - v) runs around it as the front does.
float texture_area(const Mesh& mesh, const Triangle& t, int texcoord) {
  const auto& uv = mesh.texcoords[texcoord];
  const Vec2f a = uv[t[1]] - uv[t[0]], b = uv[t[2]] - uv[t[0]];
  return a.y * b.x - a.x * b.y;
}

// After this, every vertex has triangles of one handedness only.
std::vector<float> split_by_handedness(Mesh& mesh, int texcoord) {
  std::vector<float> signs(mesh.positions.size(), 0.0f);
  std::vector<std::uint32_t> twins(mesh.positions.size(), 0);
  for (Triangle& t : mesh.triangles) {
    const float sign = texture_area(mesh, t, texcoord) < 0 ? -1.0f : 1.0f;
    for (std::uint32_t& i : t) {
      if (signs[i] == 0) signs[i] = sign;
      if (signs[i] == sign) continue;
      if (twins[i] == 0) {
        twins[i] = double_vertex(mesh, i);
        signs.push_back(sign);
      }
      i = twins[i];
    }
  }
  for (float& sign : signs) sign = sign == 0 ? 1.0f : sign;
  return signs;
}

}  // namespace

Material default_import_material() {
  Material material;
  material.name = "default";
  material.base_color = {0.8f, 0.8f, 0.8f};
  material.metallic = 0, material.perceptual_roughness = 0.5f;
  return material;
}

void MeshRepairs::add_warnings(std::vector<std::string>& warnings) const {
  if (flat_triangles > 0)
    warnings.push_back(fmt::format("{} triangles without area were dropped", flat_triangles));
  if (bad_normals > 0)
    warnings.push_back(fmt::format("{} normals are no directions; those of triangles stand in", bad_normals));
  if (bad_tangents > 0)
    warnings.push_back(fmt::format("{} tangents are no directions and were replaced", bad_tangents));
}

void repair_mesh(Mesh& mesh, MeshRepairs& repairs) {
  const std::size_t before = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return is_flat(mesh, t); });
  repairs.flat_triangles += before - mesh.triangles.size();
  repair_normals(mesh, repairs);
  repair_tangents(mesh, repairs);
}

// With e1, e2 the edges and (u1, v1), (u2, v2) theirs in the texture: dp/du = (v2 e1 - v1 e2) / (u1 v2 - u2 v1). Brought to
// the length of the area, so that slivers weigh little.
void make_tangents(Mesh& mesh, int texcoord) {
  if (!mesh.tangents.empty() || mesh.texcoords[texcoord].empty()) return;
  mesh.tangent_signs = split_by_handedness(mesh, texcoord);
  mesh.tangents.assign(mesh.positions.size(), {});
  const auto& uv = mesh.texcoords[texcoord];
  for (const Triangle& t : mesh.triangles) {
    const Vec3f e1 = mesh.positions[t[1]] - mesh.positions[t[0]],
                e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Vec2f a = uv[t[1]] - uv[t[0]], b = uv[t[2]] - uv[t[0]];
    const float sign = a.x * b.y - a.y * b.x < 0 ? -1.0f : 1.0f;
    Vec3f along = sign * (b.y * e1 - a.y * e2);
    if (!normalise(along)) continue;
    const float area = length(cross(e1, e2));
    for (std::uint32_t i : t) mesh.tangents[i] = mesh.tangents[i] + area * along;
  }
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    if (!mesh.normals.empty())
      mesh.tangents[i] = mesh.tangents[i] - dot(mesh.tangents[i], mesh.normals[i]) * mesh.normals[i];
    if (!normalise(mesh.tangents[i]))
      mesh.tangents[i] = make_frame(mesh.normals.empty() ? Vec3f{0, 0, 1} : mesh.normals[i]).tangent;
  }
}

}  // namespace welkin
