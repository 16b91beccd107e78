#include <welkin/scene/shapes.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace welkin {
namespace {

void add_vertex(Mesh& mesh, Vec3f position, Vec3f normal, Vec3f tangent, float sign, Vec2f uv) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  mesh.tangents.push_back(tangent);
  mesh.tangent_signs.push_back(sign);
  mesh.texcoords[0].push_back(uv);
}

void add_rectangle(Mesh& mesh, Vec3f corner, Vec3f across, Vec3f up) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3f normal = normalized(cross(across, up)), tangent = normalized(across);
  for (const Vec2f uv : {Vec2f{0, 1}, Vec2f{1, 1}, Vec2f{1, 0}, Vec2f{0, 0}})
    add_vertex(mesh, corner + uv.x * across + (1 - uv.y) * up, normal, tangent, 1, uv);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

int add_material(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<int>(scene.materials.size()) - 1;
}

int add_mesh(Scene& scene, Mesh mesh, int material) {
  mesh.material = material;
  scene.meshes.push_back(std::move(mesh));
  return static_cast<int>(scene.meshes.size()) - 1;
}

void add_instance(Scene& scene, int mesh, const Affine& to_world) {
  scene.instances.push_back({mesh, to_world});
}

Mesh make_rectangle(Vec3f corner, Vec3f across, Vec3f up) {
  Mesh mesh;
  mesh.name = "rectangle";
  add_rectangle(mesh, corner, across, up);
  return mesh;
}

Mesh make_box(Vec3f low, Vec3f high) {
  Mesh mesh;
  mesh.name = "box";
  const Vec3f size = high - low, x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  add_rectangle(mesh, low + z, x, y);       // +z
  add_rectangle(mesh, low + x, -x, y);      // -z
  add_rectangle(mesh, low + x + z, -z, y);  // +x
  add_rectangle(mesh, low, z, y);           // -x
  add_rectangle(mesh, low + y + z, x, -z);  // +y
  add_rectangle(mesh, low, x, z);           // -y
  return mesh;
}

// Around the axis from +z over +x, so that with the outline running upwards (u around) x (v up) points outwards:
// the direction at angle a is (sin a, 0, cos a), its derivative (cos a, 0, -sin a).
Mesh make_lathe(const std::vector<OutlinePoint>& outline, int steps) {
  Mesh mesh;
  mesh.name = "lathe";
  const auto columns = static_cast<std::uint32_t>(steps) + 1;
  const std::size_t rows = outline.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const auto [position, normal] = outline[row];
    const float v = 1 - static_cast<float>(row) / static_cast<float>(rows - 1);
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double u = static_cast<double>(column) / steps;
      // The last column is exactly the first: no seam.
      const double angle = column + 1 == columns ? 0 : 2 * std::numbers::pi * u;
      const auto s = static_cast<float>(std::sin(angle)), c = static_cast<float>(std::cos(angle));
      add_vertex(mesh, {position.x * s, position.y, position.x * c}, {normal.x * s, normal.y, normal.x * c},
                 {c, 0, -s}, 1, {static_cast<float>(u), v});
    }
  }
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    const Vec2f step = outline[row + 1].position - outline[row].position;
    if (step.x == 0 && step.y == 0) continue;
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = a + columns;
      if (outline[row].position.x > 0) mesh.triangles.push_back({a, a + 1, b + 1});
      if (outline[row + 1].position.x > 0) mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

Mesh make_torus(float major, float minor, int steps_around, int steps_across) {
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= steps_across; ++i) {
    const double angle = i == steps_across ? 0 : 2 * std::numbers::pi * i / steps_across;
    const Vec2f normal{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
    outline.push_back({{major + minor * normal.x, minor * normal.y}, normal});
  }
  Mesh mesh = make_lathe(outline, steps_around);
  mesh.name = "torus";
  return mesh;
}

}  // namespace welkin
