#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include <welkin/geometry/vec3f.h>
#include <welkin/scene/scene.h>

// Rays against a scene, through Embree 3, which stays behind ray_scene.cpp.

namespace welkin {

struct Ray {
  Vec3f origin;
  float near = 0;   ///< distances along the ray, in units of direction's length
  Vec3f direction;  ///< unit
  float far = 1e30f;
};

/// What a ray met first.
struct Hit {
  float distance = 0;
  std::uint32_t object = 0;  ///< index into Scene::instances, or Scene::instances.size() + index into spheres
  std::uint32_t triangle = 0;  ///< of the instance's mesh; 0 for a sphere
  float u = 0, v = 0;          ///< barycentric: p = (1 - u - v) p0 + u p1 + v p2; unused for a sphere
};

/// Immutable once built, thread-safe. Intersections are watertight (Embree's robust mode); what is cut out by
/// AlphaMode::mask lets rays through; AlphaMode::blend is hit with the probability of its coverage, told by a hash of the ray.
class RayScene {
 public:
  /// The scene must pass check_scene and outlive this. Degenerate triangles are kept and never hit. Throws Error when
  /// memory does not suffice.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  std::optional<Hit> closest(const Ray& ray) const;
  bool occluded(const Ray& ray) const;
  const Scene& scene() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace welkin
