#include <welkin/realtime/occlusion/depth_layer.h>

#include <algorithm>
#include <cmath>

#include <welkin/geometry/frame.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/sequence.h>
#include <welkin/sampling/warp.h>

namespace welkin {
namespace {

// Depth of a pixel's plane where the ray through (x, y) meets it: n . (p - p0) = 0. Grazing planes are cut at twice the
// change that a pixel of 84 degrees has, so that no pixel reaches far out of the layer.
float plane_depth(const DepthLayer& layer, std::size_t i, Vec3f centre, float x, float y) {
  const Vec3f n = layer.normal[i], here = layer.point(x, y, layer.orthographic ? 0.0f : 1.0f);
  const float depth = -centre.z;
  float met = depth;
  if (layer.orthographic) {
    if (std::abs(n.z) > 1e-6f) met = depth + (n.x * (here.x - centre.x) + n.y * (here.y - centre.y)) / n.z;
  } else {
    const float slope = dot(n, here);
    if (std::abs(slope) > 1e-6f) met = dot(n, centre) / slope;
  }
  const float pixel =
      layer.window.height / static_cast<float>(layer.height) * (layer.orthographic ? 1 : depth);
  return std::clamp(met, depth - 10 * pixel, depth + 10 * pixel);
}

struct RayOnScreen {
  Vec3f origin, direction;
  Vec2f from, to;  // pixels
  float reach;     // metres
};

// The part of the ray that can be seen: cut before the eye's plane.
RayOnScreen put_on_screen(const DepthLayer& layer, Vec3f origin, Vec3f direction, float reach) {
  if (!layer.orthographic && direction.z > 0) reach = std::min(reach, -0.98f * origin.z / direction.z);
  return {origin, direction, layer.pixel_of(origin), layer.pixel_of(origin + reach * direction), reach};
}

// Distance along the ray where it is seen at the share s of its way across the screen. Perspective: 1 / depth is linear in s.
float distance_at(const DepthLayer& layer, const RayOnScreen& ray, float s) {
  if (layer.orthographic) return s * ray.reach;
  const float start = -ray.origin.z, end = start - ray.reach * ray.direction.z;
  return ray.reach * s * start / (end + s * (start - end));
}

// How far behind a pixel's plane the ray is where it is seen at the share s of its way.
float behind_plane(const DepthLayer& layer, const RayOnScreen& ray, std::size_t pixel, Vec3f centre,
                   float s) {
  const float x = ray.from.x + s * (ray.to.x - ray.from.x), y = ray.from.y + s * (ray.to.y - ray.from.y);
  const float depth = -(ray.origin.z + distance_at(layer, ray, s) * ray.direction.z);
  return depth - plane_depth(layer, pixel, centre, x, y);
}

// One pixel a step: the ray's way through it is blocked where any of it lies within the sheet.
bool blocked(const DepthLayer& layer, const LayerTraceOptions& options, const RayOnScreen& ray) {
  const float dx = ray.to.x - ray.from.x, dy = ray.to.y - ray.from.y;
  const float way = std::max(std::abs(dx), std::abs(dy));
  for (int i = 1; static_cast<float>(i) <= way + 0.5f; ++i) {
    const float s = std::min(static_cast<float>(i) / way, 1.0f);
    const float x = ray.from.x + s * dx, y = ray.from.y + s * dy;
    if (x < 0 || y < 0 || x >= static_cast<float>(layer.width) || y >= static_cast<float>(layer.height))
      return false;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const std::size_t pixel = layer.index(column, row);
    if (layer.depth[pixel] <= 0) continue;
    const Vec3f centre = layer.point_of_pixel(column, row);
    const float begin = (static_cast<float>(i) - 0.5f) / way, end = (static_cast<float>(i) + 0.5f) / way;
    const float entry = behind_plane(layer, ray, pixel, centre, std::min(begin, 1.0f));
    const float exit = behind_plane(layer, ray, pixel, centre, std::min(end, 1.0f));
    const float margin = -2e-4f * centre.z;
    if (std::max(entry, exit) > margin && std::min(entry, exit) < options.thickness_metres) return true;
  }
  return false;
}

float open_share(const DepthLayer& layer, const LayerTraceOptions& options, int x, int y) {
  const std::size_t pixel = layer.index(x, y);
  if (layer.depth[pixel] <= 0) return 1;
  const LocalFrame frame = make_frame(layer.normal[pixel]);
  const Vec3f origin = layer.point_of_pixel(x, y);
  // Each pixel turns the set by numbers of its own, so that errors of neighbours do not agree.
  const Point2 turn = r2_point(pixel);
  int open = 0;
  for (int i = 0; i < options.rays; ++i) {
    const Point2 u =
        hammersley_point(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(options.rays));
    const auto turned = [&](int k) { return static_cast<float>(std::fmod(u[k] + turn[k], 1.0)); };
    const Vec3f direction = frame.to_world(warp_to_cosine_hemisphere({turned(0), turned(1)}));
    open += blocked(layer, options, put_on_screen(layer, origin, direction, options.radius_metres)) ? 0 : 1;
  }
  return static_cast<float>(open) / static_cast<float>(options.rays);
}

}  // namespace

DepthLayer make_depth_layer(const Image& depth, const Image& normal, const View& view) {
  DepthLayer layer;
  layer.width = view.width;
  layer.height = view.height;
  layer.orthographic = view.orthographic;
  layer.window = view_window(view);
  const std::size_t count = static_cast<std::size_t>(view.width) * view.height;
  layer.depth.resize(count);
  layer.normal.resize(count);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const float* n = normal.at(x, view.height - 1 - y);
      const Vec3f direction{n[0], n[1], n[2]};
      layer.depth[layer.index(x, y)] = *depth.at(x, view.height - 1 - y);
      layer.normal[layer.index(x, y)] =
          dot(direction, direction) > 0 ? normalized(direction) : Vec3f{0, 0, 1};
    }
  }
  return layer;
}

Image trace_depth_layer(const DepthLayer& layer, const LayerTraceOptions& options) {
  Image share(layer.width, layer.height, 1);
  parallel_for(static_cast<std::size_t>(layer.height), 4, [&](std::size_t begin, std::size_t end) {
    for (int row = static_cast<int>(begin); row < static_cast<int>(end); ++row) {
      for (int x = 0; x < layer.width; ++x)
        *share.at(x, row) = open_share(layer, options, x, layer.height - 1 - row);
    }
  });
  return share;
}

}  // namespace welkin
