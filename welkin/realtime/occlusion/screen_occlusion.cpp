#include <welkin/realtime/occlusion/screen_occlusion.h>

#include <cassert>

namespace welkin {
namespace {

struct MethodShader {
  const char *file, *defines;
};

constexpr MethodShader shaders[occlusion_methods] = {
    {"occlusion_points.frag", "#define HEMISPHERE 0\n"},
    {"occlusion_points.frag", "#define HEMISPHERE 1\n"},
};

// The columns of the camera's axes in the world.
Affine view_to_world(const View& view) {
  const float* m = view.world_to_view.m;
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {}};
}

void set_layer(const Program& program, const RenderTarget& geometry, const View& view) {
  program.set_texture("depth_layer", first_technique_unit, GL_TEXTURE_2D, geometry.colors[0]);
  program.set_texture("view_normals", first_technique_unit + 1, GL_TEXTURE_2D, geometry.colors[1]);
  const ViewWindow window = view_window(view);
  program.set_vec4("view_window", window.left, window.bottom, window.width, window.height);
  program.set("orthographic", view.orthographic ? 1 : 0);
  program.set_linear("view_to_world", view_to_world(view));
}

void set_options(const Program& program, const OcclusionOptions& options) {
  program.set("radius", options.radius_metres);
  program.set("largest_radius_pixels", options.largest_radius_pixels);
  program.set("falloff", options.falloff);
  program.set("samples", options.samples);
}

}  // namespace

const Program& ScreenOcclusion::program(OcclusionMethod method) {
  Program& program = programs_[static_cast<int>(method)];
  const MethodShader& shader = shaders[static_cast<int>(method)];
  if (!program) program = Program("fullscreen.vert", shader.file, shader.defines);
  return program;
}

void ScreenOcclusion::draw(const GpuScene& scene, const View& view, const OcclusionOptions& options,
                           const Fullscreen& fullscreen, PassTimer& timer) {
  assert(options.radius_metres > 0 && options.samples > 0);
  {
    const PassTimer::Scope timed(timer, "geometry");
    geometry_.draw(scene, view);
  }
  if (openness_.width != view.width || openness_.height != view.height) {
    static constexpr TexelFormat format = TexelFormat::rgba16f;
    openness_ = {};
    openness_ = make_render_target(view.width, view.height, &format, 1, false);
  }
  const PassTimer::Scope timed(timer, "occlusion");
  const Program& chosen = program(options.method);
  openness_.bind();
  glDisable(GL_DEPTH_TEST);
  chosen.use();
  set_layer(chosen, geometry_.target(), view);
  set_options(chosen, options);
  fullscreen.draw();
}

void set_screen_occlusion(const Program& program, const ScreenOcclusion& occlusion, int unit) {
  program.set_texture("screen_openness", unit, GL_TEXTURE_2D, occlusion.openness().colors[0]);
}

}  // namespace welkin
