#pragma once
#include <algorithm>

#include <welkin/pathtrace/camera_ray.h>
#include <welkin/pathtrace/render_scene.h>
#include <welkin/sampling/sobol.h>
#include <welkin/sampling/warp.h>

namespace welkin {

/// Ambient occlusion as a template on what traces the rays (see path.h): the share of the cosine-weighted hemisphere about
/// the shading normal in which nothing is nearer than options.occlusion_distance. 1 where nothing is seen at all.
template <class Rays>
class OcclusionTracer {
 public:
  OcclusionTracer(const RenderScene::Tables& tables, const IntegratorOptions& options, Rays& rays)
      : tables_(tables), options_(options), rays_(rays) {}

  /// index and seed are the sample's: its rays are numbered on through all samples of the pixel.
  void trace(const Ray& ray, std::uint32_t index, std::uint32_t seed, PixelSample& sample, Vec3f& first) {
    const std::optional<Hit> hit = rays_.closest(ray);
    if (!hit) {
      if (options_.show_environment) sample.radiance = {1, 1, 1};
      return;
    }
    ShadingPoint point;
    point.surface = surface_at(tables_.rays, *hit, ray);
    prepare_shading(tables_.scene, tables_.materials, ray.direction, point);
    first = point.surface.position;
    sample.coverage = 1;
    sample.normal = point.frame.normal;
    sample.albedo = approximate_albedo(*point.scatter, point.view);
    const std::uint32_t count = std::max(options_.occlusion_rays, 1);
    int open = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      open += is_open(point, SampleStream(index * count + i, seed ^ 0x5bd1e995u).next_2d());
    }
    const float share = static_cast<float>(open) / static_cast<float>(count);
    sample.radiance = {share, share, share};
  }

 private:
  bool is_open(const ShadingPoint& point, Vec2f u) {
    const Vec3f direction = point.frame.to_world(warp_to_cosine_hemisphere(u));
    if (!point.faces(direction)) return false;
    return !rays_.occluded(
        {leave_surface(point.surface, direction), 0, direction, options_.occlusion_distance});
  }

  const RenderScene::Tables& tables_;
  const IntegratorOptions& options_;
  Rays& rays_;
};

}  // namespace welkin
