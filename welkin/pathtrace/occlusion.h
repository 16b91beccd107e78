#pragma once
#include <algorithm>
#include <span>

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

  /// One sample of a pixel: its number with the pixel's own seed, and what it fills.
  struct Sample {
    SampleNumber number;
    PixelSample* pixel = nullptr;
    Vec3f first;

    void begin(SampleNumber in_pixel, const SampleStream&) { number = in_pixel; }
  };

  void trace(std::span<const Ray> camera_rays, Sample* samples) {
    Hit hits[RayScene::batch_size];
    const std::uint32_t met = rays_.closest(camera_rays, hits, RayKind::side_by_side);
    prefetch_surfaces(tables_.rays, met, hits);
    for (std::size_t i = 0; i < camera_rays.size(); ++i) {
      if ((met >> i & 1) != 0) {
        look_around(camera_rays[i], hits[i], samples[i]);
      } else if (options_.show_environment) {
        samples[i].pixel->radiance = {1, 1, 1};
      }
    }
    flush();
  }

 private:
  /// The rays of a surface are numbered on through all samples of the pixel, so that they are stratified together.
  void look_around(const Ray& ray, const Hit& hit, Sample& sample) {
    ShadingPoint point;
    point.surface = surface_at(tables_.rays, hit, ray);
    prepare_shading(tables_.scene, tables_.materials, ray.direction, point);
    sample.first = point.surface.position;
    sample.pixel->coverage = 1;
    sample.pixel->normal = point.frame.normal;
    sample.pixel->albedo = approximate_albedo(*point.scatter, point.view);
    const std::uint32_t count = std::max(options_.occlusion_rays, 1);
    share_ = 1 / static_cast<float>(count);
    Vec2f u[RayScene::batch_size];
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t in_batch = i % RayScene::batch_size;
      if (in_batch == 0) fill(sample.number, count, i, u);
      const Vec3f direction = point.frame.to_world(warp_to_cosine_hemisphere(u[in_batch]));
      if (!point.faces(direction)) continue;
      pending_[pending_count_] = {leave_surface(point.surface, direction), 0, direction,
                                  options_.occlusion_distance};
      owner_[pending_count_++] = sample.pixel;
      if (pending_count_ == RayScene::batch_size) flush();
    }
  }

  /// The numbers of the rays from `first` on of a sample's `count`, those of a batch at most.
  static void fill(SampleNumber number, std::uint32_t count, std::uint32_t first, Vec2f* u) {
    SampleStream streams[RayScene::batch_size];
    SampleStream* pointers[RayScene::batch_size];
    const std::size_t batch = std::min<std::size_t>(count - first, RayScene::batch_size);
    for (std::uint32_t i = 0; i < batch; ++i) {
      streams[i] = SampleStream(number.index * count + first + i, number.seed ^ 0x5bd1e995u);
      pointers[i] = &streams[i];
    }
    next_2d(std::span<SampleStream* const>(pointers, batch), u);
  }

  /// Traces what is pending; each open ray counts for its sample.
  void flush() {
    const std::uint32_t hidden = rays_.occluded(std::span<const Ray>(pending_, pending_count_));
    for (std::size_t i = 0; i < pending_count_; ++i) {
      if ((hidden >> i & 1) == 0) owner_[i]->radiance += Rgb{share_, share_, share_};
    }
    pending_count_ = 0;
  }

  const RenderScene::Tables& tables_;
  const IntegratorOptions& options_;
  Rays& rays_;
  Ray pending_[RayScene::batch_size];
  PixelSample* owner_[RayScene::batch_size];
  std::size_t pending_count_ = 0;
  float share_ = 1;
};

}  // namespace welkin
