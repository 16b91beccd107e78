#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/image/rgb.h>
#include <welkin/raytrace/surface.h>
#include <welkin/sampling/discrete.h>
#include <welkin/scene/scene.h>

// All lights of a scene and one way to pick among them: the environment, punctual lights, spheres and triangles that emit.

namespace welkin {

/// A light as seen from a point.
struct LightSample {
  Vec3f direction;  ///< unit, from the point to the light
  float distance = 1e30f;
  Rgb radiance;  ///< black: no sample. For `is_delta` the irradiance on a surface that faces the light
  float pdf =
      0;  ///< per steradian, with the choice of the light in it; for is_delta the choice's probability alone
  bool is_delta = false;
  Vec3f target;  ///< where the light's surface is, moved off it; unused where distance is 1e30f
};

/// What a light is picked for: a point, a number in [0, 1) that picks the light and two that pick a point of it.
struct LightQuery {
  Vec3f from;
  float select = 0;
  Vec2f u;
};

struct TriangleLight {
  Vec3f corner, edge_u, edge_v;  ///< world
  Vec3f normal;                  ///< unit, of the front
  float area = 0;                ///< m^2, > 0
  float offset = 0;              ///< metres: what moves a point safely off the triangle
  int material = 0;
  std::uint32_t object = 0, triangle = 0;
};

struct SphereLight {
  Vec3f centre;
  float radius = 0;
  int material = 0;
};

/// Lights are chosen by their power: that of the environment is what enters the scene's bounding sphere, that of a
/// directional light the same. A quarter of the choices is shared evenly among the three groups (environment, punctual
/// lights, surfaces), because power says nothing of who is near. Immutable, thread-safe.
class LightTable {
 public:
  LightTable(const RayScene& rays, const EnvironmentSampler* environment);

  bool empty() const { return choice_.empty(); }
  /// Whether anything but punctual lights is here.
  bool has_area_lights() const { return punctual_share_ < 1; }
  bool has_punctual_lights() const { return punctual_share_ > 0; }

  /// A light for select in [0, 1) and a point of it for u in [0, 1)^2. Not for an empty table.
  LightSample sample(Vec3f from, float select, Vec2f u) const;
  /// The same for at most 16 queries, with the environment's tables read for all together.
  void sample(std::span<const LightQuery> queries, LightSample* samples) const;
  /// The same among punctual lights alone; needs has_punctual_lights().
  LightSample sample_punctual(Vec3f from, float select) const;

  /// With which density sample() finds the environment there, whose own density is environment_pdf.
  float pdf_of_environment(float environment_pdf) const { return environment_share_ * environment_pdf; }
  /// With which density sample(from, ...) finds this surface, per steradian; 0 for what does not emit.
  float pdf_of_surface(Vec3f from, const Hit& hit, const Surface& surface) const;

  /// Radiance that leaves a surface point, from the side that `front` says.
  Rgb emission(int material, bool front, const Vec2f (&texcoords)[2]) const;

 private:
  std::size_t first_triangle() const { return first_sphere_ + spheres_.size(); }
  LightSample from_chosen(const LightQuery& query, const DiscreteDistribution::Choice& choice) const;
  LightSample from_punctual(Vec3f from, const PunctualLight& light) const;
  LightSample from_sphere(Vec3f from, const SphereLight& light, Vec2f u) const;
  LightSample from_triangle(Vec3f from, const TriangleLight& light, Vec2f u) const;
  float sphere_pdf(Vec3f from, const SphereLight& light) const;
  void add_spheres();
  void add_triangles(const RayScene& rays);
  void set_shares(double environment_luminance);

  const Scene* scene_;
  const EnvironmentSampler* environment_;  ///< null where it is black
  std::vector<TriangleLight> triangles_;
  std::vector<SphereLight> spheres_;
  DiscreteDistribution choice_;             ///< among punctual lights, environment, spheres, triangles
  std::vector<std::uint32_t> first_light_;  ///< by object: of its first triangle in triangles_, or its sphere
  std::size_t first_sphere_ = 0;            ///< index of the first sphere in choice_
  float punctual_share_ = 0, environment_share_ = 0;
};

}  // namespace welkin
