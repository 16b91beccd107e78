#pragma once
#include <algorithm>

#include <welkin/pathtrace/occlusion.h>
#include <welkin/pathtrace/path.h>
#include <welkin/raytrace/flush_denormals.h>

namespace welkin {

/// render_samples (integrator.h) with the rays traced by `rays`.
template <class Rays>
void render_samples_with(Rays& rays, const RenderScene& scene, const Camera& camera, PictureSize size, int x,
                         int y, std::uint32_t first, std::span<PixelSample> samples,
                         const IntegratorOptions& options) {
  const FlushDenormals flush;
  const auto pixel =
      static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(size.width) + static_cast<std::uint32_t>(x);
  const std::uint32_t seed = mix_bits32(mix_bits32(options.seed + 0x632be5abu) + pixel);
  const CameraRays view(camera, size);
  const auto trace_batch = [&](auto& tracer, std::size_t begin, std::size_t count, auto&& prepare) {
    Ray camera_rays[RayScene::batch_size];
    typename std::remove_reference_t<decltype(tracer)>::Sample batch[RayScene::batch_size];
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t index = first + static_cast<std::uint32_t>(begin + i);
      SampleStream stream(index, seed);
      const Vec2f in_pixel = stream.next_2d();
      camera_rays[i] = view.ray(static_cast<float>(x) + in_pixel.x, static_cast<float>(y) + in_pixel.y);
      samples[begin + i] = PixelSample();
      batch[i].pixel = &samples[begin + i];
      prepare(batch[i], index, stream);
    }
    tracer.trace(std::span<const Ray>(camera_rays, count), batch);
    for (std::size_t i = 0; i < count; ++i) {
      PixelSample& done = *batch[i].pixel;
      if (done.coverage > 0) done.depth = camera_depth(camera, batch[i].first);
    }
  };
  for (std::size_t begin = 0; begin < samples.size(); begin += RayScene::batch_size) {
    const std::size_t count = std::min(samples.size() - begin, RayScene::batch_size);
    if (options.integrator == Integrator::ambient_occlusion) {
      OcclusionTracer tracer(scene.tables(), options, rays);
      trace_batch(tracer, begin, count, [&](auto& sample, std::uint32_t index, const SampleStream&) {
        sample.index = index;
        sample.seed = seed;
      });
    } else {
      PathTracer tracer(scene.tables(), options, rays);
      trace_batch(tracer, begin, count,
                  [](auto& sample, std::uint32_t, const SampleStream& stream) { sample.stream = stream; });
    }
  }
}

}  // namespace welkin
