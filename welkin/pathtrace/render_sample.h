#pragma once
#include <algorithm>
#include <cassert>

#include <welkin/pathtrace/image_based.h>
#include <welkin/pathtrace/occlusion.h>
#include <welkin/pathtrace/path.h>
#include <welkin/raytrace/flush_denormals.h>

namespace welkin {

/// render_samples (integrator.h) with the rays traced by `rays`.
template <class Rays>
void render_samples_with(Rays& rays, const RenderScene& scene, const Camera& camera, PictureSize size, int x,
                         int y, std::span<const SampleNumber> numbers, const IntegratorOptions& options,
                         std::span<PixelSample> out) {
  assert(out.size() == numbers.size());
  const FlushDenormals flush;
  const auto pixel =
      static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(size.width) + static_cast<std::uint32_t>(x);
  const CameraRays view(camera, size);
  const auto trace_batch = [&](auto& tracer, std::size_t begin, std::size_t count) {
    Ray camera_rays[RayScene::batch_size];
    typename std::remove_reference_t<decltype(tracer)>::Sample batch[RayScene::batch_size];
    SampleStream streams[RayScene::batch_size];
    SampleStream* pointers[RayScene::batch_size];
    Vec2f in_pixel[RayScene::batch_size];
    const auto seed_of = [&](SampleNumber number) {
      return mix_bits32(mix_bits32(number.seed + 0x632be5abu) + pixel);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const SampleNumber number = numbers[begin + i];
      streams[i] = SampleStream(number.index, seed_of(number));
      pointers[i] = &streams[i];
    }
    next_2d(std::span<SampleStream* const>(pointers, count), in_pixel);
    for (std::size_t i = 0; i < count; ++i) {
      const SampleNumber number = numbers[begin + i];
      camera_rays[i] = view.ray(static_cast<float>(x) + in_pixel[i].x, static_cast<float>(y) + in_pixel[i].y);
      out[begin + i] = PixelSample();
      batch[i].pixel = &out[begin + i];
      batch[i].begin({number.index, seed_of(number)}, streams[i]);
    }
    tracer.trace(std::span<const Ray>(camera_rays, count), batch);
    for (std::size_t i = 0; i < count; ++i) {
      PixelSample& done = *batch[i].pixel;
      if (done.coverage > 0) done.depth = camera_depth(camera, batch[i].first);
    }
  };
  for (std::size_t begin = 0; begin < out.size(); begin += RayScene::batch_size) {
    const std::size_t count = std::min(out.size() - begin, RayScene::batch_size);
    if (options.integrator == Integrator::ambient_occlusion) {
      OcclusionTracer tracer(scene.tables(), options, rays);
      trace_batch(tracer, begin, count);
    } else if (options.integrator == Integrator::image_based) {
      assert(options.image_based != nullptr);
      ImageBasedTracer tracer(scene.tables(), options, rays);
      trace_batch(tracer, begin, count);
    } else {
      PathTracer tracer(scene.tables(), options, rays);
      trace_batch(tracer, begin, count);
    }
  }
}

}  // namespace welkin
