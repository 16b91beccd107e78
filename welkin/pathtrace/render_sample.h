#pragma once
#include <cmath>

#include <welkin/pathtrace/occlusion.h>
#include <welkin/pathtrace/path.h>
#include <welkin/raytrace/flush_denormals.h>

namespace welkin {

/// render_sample (integrator.h) with the rays traced by `rays`, in the order in which they come up.
template <class Rays>
PixelSample render_sample_with(Rays& rays, const RenderScene& scene, const Camera& camera, PictureSize size,
                               int x, int y, std::uint32_t index, const IntegratorOptions& options) {
  const FlushDenormals flush;
  const auto pixel =
      static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(size.width) + static_cast<std::uint32_t>(x);
  const std::uint32_t seed = mix_bits32(mix_bits32(options.seed + 0x632be5abu) + pixel);
  SampleStream stream(index, seed);
  const Vec2f in_pixel = stream.next_2d();
  const Ray ray =
      camera_ray(camera, size, static_cast<float>(x) + in_pixel.x, static_cast<float>(y) + in_pixel.y);
  PixelSample sample;
  Vec3f first;
  if (options.integrator == Integrator::ambient_occlusion) {
    OcclusionTracer(scene.tables(), options, rays).trace(ray, index, seed, sample, first);
  } else {
    PathTracer(scene.tables(), options, rays).trace(ray, stream, sample, first);
  }
  if (sample.coverage > 0) sample.depth = camera_depth(camera, first);
  return sample;
}

}  // namespace welkin
