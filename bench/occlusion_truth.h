#pragma once
#include <cmath>
#include <cstdint>

#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/camera_ray.h>
#include <welkin/raytrace/flush_denormals.h>
#include <welkin/raytrace/surface.h>
#include <welkin/sampling/sequence.h>
#include <welkin/sampling/warp.h>

// Ray-traced ambient occlusion at the very points that a rasteriser shades: the middles of the pixels.

namespace bench {

inline float open_share(const welkin::RayScene& rays, const welkin::Ray& ray, std::size_t pixel, float radius,
                        int count) {
  const auto hit = rays.closest(ray);
  if (!hit) return 1;
  const welkin::Surface surface = surface_at(rays, *hit, ray);
  welkin::Vec3f normal = surface.shading.normal, geometric = surface.geometric_normal;
  if (dot(geometric, ray.direction) > 0) geometric = -geometric;
  if (dot(normal, geometric) < 0) normal = -normal;
  const welkin::LocalFrame frame = welkin::make_frame(normal);
  const welkin::Point2 turn = welkin::r2_point(pixel);
  int open = 0;
  for (int i = 0; i < count; ++i) {
    const welkin::Point2 u =
        welkin::hammersley_point(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(count));
    const auto turned = [&](int k) { return static_cast<float>(std::fmod(u[k] + turn[k], 1.0)); };
    const welkin::Vec3f direction = frame.to_world(welkin::warp_to_cosine_hemisphere({turned(0), turned(1)}));
    if (dot(direction, geometric) <= 0) continue;
    open += rays.occluded({leave_surface(surface, direction), 0, direction, radius}) ? 0 : 1;
  }
  return static_cast<float>(open) / static_cast<float>(count);
}

/// One channel, row 0 the top; 1 where nothing is seen. `count` rays a pixel, nearer than `radius` metres.
inline welkin::Image traced_occlusion(const welkin::Scene& scene, int width, int height, float radius,
                                      int count) {
  const welkin::RayScene rays(scene);
  const welkin::CameraRays camera(scene.cameras[0], {width, height});
  welkin::Image share(width, height, 1);
  welkin::parallel_for(static_cast<std::size_t>(height), 4, [&](std::size_t begin, std::size_t end) {
    const welkin::FlushDenormals flush;
    for (std::size_t row = begin; row < end; ++row) {
      for (int x = 0; x < width; ++x) {
        const std::size_t pixel = row * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
        const welkin::Ray ray = camera.ray(static_cast<float>(x) + 0.5f, static_cast<float>(row) + 0.5f);
        share.pixels[pixel] = open_share(rays, ray, pixel, radius, count);
      }
    }
  });
  return share;
}

}  // namespace bench
