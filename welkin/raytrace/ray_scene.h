#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

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

/// Whether the rays of a batch go much the same way, as a camera's do.
enum class RayKind { scattered, side_by_side };

/// An instance as the rays see it: what surface_at needs of it.
struct PlacedMesh {
  const Mesh* mesh = nullptr;
  const Vec3f* positions = nullptr;  ///< in the world where `in_world`, else the mesh's own
  Affine to_world;
  bool in_world = false;  ///< the tree has this mesh's triangles in the world frame
  bool unmoved = false;   ///< to_world is the identity
  bool mirrored = false;  ///< determinant(to_world) < 0
  float transform_error =
      0;  ///< error of a ray's way into the mesh's frame and back, relative to the coordinates
  float origin_size = 0;  ///< largest of |to_world.origin|'s coordinates
};

/// Immutable once built, thread-safe. Intersections are watertight (Embree's robust mode); what is cut out by
/// AlphaMode::mask lets rays through; AlphaMode::blend is hit with the probability of its coverage, told by a hash of the
/// ray. Meshes that are used once have their triangles in the one tree, in the world frame; others have a tree of their
/// own, entered through their instances. Threads that trace should hold a FlushDenormals (flush_denormals.h).
class RayScene {
 public:
  /// The scene must pass check_scene and outlive this. Degenerate triangles are kept and never hit; instances that
  /// flatten space (determinant 0) are flattened with it. Throws Error naming scene.source when memory does not suffice.
  explicit RayScene(const Scene& scene);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  std::optional<Hit> closest(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

  /// Up to batch_size rays at once: faster where they are near each other, such as those of one pixel or one point. Bit i
  /// of the result tells whether rays[i] met something; hits[i], for closest, what it was. Which of Embree's kernels
  /// meets a ray depends on the others in the batch, so hits are the same as those of single rays but for rounding.
  /// For side_by_side rays another kernel runs: 2.5 times as fast where they are, slower where they are not.
  static constexpr std::size_t batch_size = 16;
  std::uint32_t closest(std::span<const Ray> rays, Hit* hits, RayKind kind) const;
  std::uint32_t occluded(std::span<const Ray> rays) const;
  const Scene& scene() const;
  const std::vector<PlacedMesh>& placed() const;  ///< one for each of scene().instances

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace welkin
