#include <welkin/scene/scene.h>

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

// A box that grows; empty while low > high.
struct Box {
  Vec3f low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  bool empty() const { return low.x > high.x; }
  void add(Vec3f p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  Vec3f corner(int i) const {
    return {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  }
};

// Only vertices that a triangle uses.
Box box_of(const Mesh& mesh, const Affine& to_world) {
  Box box;
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t vertex : triangle) box.add(to_world.point(mesh.positions[vertex]));
  }
  return box;
}

void add_instances(Box& all, const Scene& scene) {
  std::vector<std::uint32_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  std::vector<Box> boxes(scene.meshes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (uses[i] > 1) boxes[i] = box_of(scene.meshes[i], {});
  }
  for (const Instance& instance : scene.instances) {
    const bool once = uses[instance.mesh] == 1;
    const Box box = once ? box_of(scene.meshes[instance.mesh], instance.to_world) : boxes[instance.mesh];
    if (box.empty()) continue;
    for (int i = 0; i < 8; ++i) all.add(once ? box.corner(i) : instance.to_world.point(box.corner(i)));
  }
}

}  // namespace

std::optional<Bounds> scene_bounds(const Scene& scene) {
  Box box;
  add_instances(box, scene);
  for (const Sphere& sphere : scene.spheres) {
    const Vec3f reach{sphere.radius, sphere.radius, sphere.radius};
    box.add(sphere.centre - reach);
    box.add(sphere.centre + reach);
  }
  if (box.empty()) return std::nullopt;
  return Bounds{box.low, box.high};
}

// A corner at (x, y, z) of the camera's frame about the centre is inside the picture from the distance d where
// |y| <= t (d - z) and |x| <= t a (d - z), t the tangent of half the field and a the picture's width over its height.
Camera default_camera(const Bounds& bounds, double width_over_height) {
  constexpr float margin = 1.05f;
  const Vec3f centre = 0.5f * (bounds.low + bounds.high), back = normalized({0.25f, 0.35f, 1});
  Camera camera;
  camera.name = "default";
  camera.to_world = look_at(centre + back, centre, {0, 1, 0});
  const float t = std::tan(camera.vertical_field_radians / 2) / margin;
  const float across = t * static_cast<float>(width_over_height);
  const Box box{bounds.low, bounds.high};
  float distance = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3f p = box.corner(i) - centre;
    const float x = std::fabs(dot(p, camera.to_world.x)), y = std::fabs(dot(p, camera.to_world.y));
    distance = std::max(distance, dot(p, camera.to_world.z) + std::max(y / t, x / across));
  }
  camera.to_world.origin = centre + (distance > 0 ? distance : 1.0f) * camera.to_world.z;
  return camera;
}

}  // namespace welkin
