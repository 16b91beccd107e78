#pragma once
#include <vector>

#include <welkin/geometry/vec3f.h>
#include <welkin/image/image.h>
#include <welkin/realtime/occlusion/geometry_pass.h>

// What screen-space methods know, on the processor: their truth by brute force, and scalar forms of the best of them.

namespace welkin {

/// Depth and normals of a picture; rows from the bottom, as OpenGL has them. Camera's frame: x right, y up, z towards the eye.
struct DepthLayer {
  int width = 0, height = 0;
  bool orthographic = false;
  ViewWindow window;
  std::vector<float> depth;   ///< metres along the view axis; 0: nothing there
  std::vector<Vec3f> normal;  ///< unit, facing the viewer; anything where there is nothing

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
  /// The point at `depth` that is seen at (x, y), in pixels from the bottom left corner.
  Vec3f point(float x, float y, float at_depth) const {
    const float across = window.left + window.width * x / static_cast<float>(width);
    const float up = window.bottom + window.height * y / static_cast<float>(height);
    const float scale = orthographic ? 1.0f : at_depth;
    return {across * scale, up * scale, -at_depth};
  }
  Vec3f point_of_pixel(int x, int y) const {
    return point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, depth[index(x, y)]);
  }
  /// Where a point is seen, pixels from the bottom left corner; perspective: it must lie before the eye.
  Vec2f pixel_of(Vec3f p) const {
    const float scale = orthographic ? 1.0f : -1 / p.z;
    return {(p.x * scale - window.left) / window.width * static_cast<float>(width),
            (p.y * scale - window.bottom) / window.height * static_cast<float>(height)};
  }
};

/// From the two pictures of a GeometryPass, read by read_pixels.
DepthLayer make_depth_layer(const Image& depth, const Image& normal, const View& view);

struct LayerTraceOptions {
  float radius_metres = 0.5f;
  float thickness_metres = 1e30f;  ///< of everything that is seen, away from the eye; 1e30: solid
  int rays = 256;                  ///< of a pixel, cosine-weighted
};

/// Ray-traced ambient occlusion of the layer: what a perfect screen-space method would find. Every pixel is a piece of its plane (point
/// and normal), as thick as said along the view ray. A ray visits the pixels that it is seen in one after the other and is
/// blocked where it lies behind the pixel's plane by less than the thickness. One channel, row 0 the top; 1 where nothing is seen.
Image trace_depth_layer(const DepthLayer& layer, const LayerTraceOptions& options);

}  // namespace welkin
