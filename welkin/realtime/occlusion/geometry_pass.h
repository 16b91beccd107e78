#pragma once
#include <welkin/realtime/gpu_scene.h>

namespace welkin {

/// What the camera sees, for methods that work in screen space. colors[0]: r32f, distance along the view axis in metres, 0 where
/// there is nothing; colors[1]: rgba16f, shading normal in the camera's frame (x right, y up, z towards the eye), facing the viewer.
class GeometryPass {
 public:
  GeometryPass();
  /// Draws all of the scene at view.width x view.height; leaves its own framebuffer bound.
  void draw(const GpuScene& scene, const View& view);
  const RenderTarget& target() const { return target_; }

 private:
  Program program_;
  RenderTarget target_;
};

/// Corner and size of what the picture shows at depth 1 (anywhere for orthographic views), in metres of the camera's frame.
struct ViewWindow {
  float left = 0, bottom = 0, width = 0, height = 0;
};
ViewWindow view_window(const View& view);

}  // namespace welkin
