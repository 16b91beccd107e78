#include <welkin/realtime/occlusion/geometry_pass.h>

namespace welkin {

GeometryPass::GeometryPass() : program_("mesh.vert", "occlusion_geometry.frag") {}

void GeometryPass::draw(const GpuScene& scene, const View& view) {
  if (target_.width != view.width || target_.height != view.height) {
    static constexpr TexelFormat formats[] = {TexelFormat::r32f, TexelFormat::rgba16f};
    target_ = {};
    target_ = make_render_target(view.width, view.height, formats, 2, true);
  }
  target_.bind();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program_.use();
  draw_scene(program_, scene, view);
}

ViewWindow view_window(const View& view) {
  const float x = 1 / view.view_to_clip.m[0], y = 1 / view.view_to_clip.m[5];
  return {-x, -y, 2 * x, 2 * y};
}

}  // namespace welkin
