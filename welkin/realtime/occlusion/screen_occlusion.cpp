#include <welkin/realtime/occlusion/screen_occlusion.h>

#include <algorithm>
#include <cassert>
#include <string>

namespace welkin {
namespace {

struct MethodShader {
  const char *file, *defines;
};

constexpr MethodShader shaders[occlusion_methods] = {
    {"occlusion_points.frag", "#define HEMISPHERE 0\n"},
    {"occlusion_points.frag", "#define HEMISPHERE 1\n"},
    {"occlusion_alchemy.frag", "#define SPIRAL 0\n"},
    {"occlusion_alchemy.frag", "#define SPIRAL 1\n"},
    {"occlusion_gtao.frag", ""},
    {"occlusion_bitmask.frag", ""},
    {"occlusion_sectors.frag", ""},
};

// Levels below the full one: at most five, none smaller than a pixel.
int small_levels(int width, int height) {
  int levels = 0;
  while (levels < 5 && (std::min(width, height) >> (levels + 1)) > 0) ++levels;
  return levels;
}

void fit(RenderTarget& target, int width, int height, TexelFormat format) {
  if (target.width == width && target.height == height) return;
  target = {};
  target = make_render_target(width, height, &format, 1, false);
}

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
  program.set("slices", options.slices);
  program.set("steps", options.steps);
  program.set("step_power", options.step_power);
  program.set("thickness", options.thickness_metres);
  program.set("thin", options.thin);
  program.set("intensity", options.intensity);
  program.set("bias", 1e-4f);
}

}  // namespace

const Program& ScreenOcclusion::program(const OcclusionOptions& options) {
  Program& program = programs_[options.bent_normals ? 1 : 0][static_cast<int>(options.method)];
  const MethodShader& shader = shaders[static_cast<int>(options.method)];
  const std::string bent = options.bent_normals ? "#define BENT_NORMALS\n" : "";
  if (!program) program = Program("fullscreen.vert", shader.file, shader.defines + bent);
  return program;
}

void ScreenOcclusion::draw(const GpuScene& scene, const View& view, const OcclusionOptions& options,
                           const Fullscreen& fullscreen, PassTimer& timer) {
  assert(options.radius_metres > 0 && options.samples > 0);
  {
    const PassTimer::Scope timed(timer, "geometry");
    geometry_.draw(scene, view);
  }
  fit(openness_, view.width, view.height, TexelFormat::rgba16f);
  {
    const PassTimer::Scope timed(timer, "occlusion");
    find_openness(view, options, fullscreen);
  }
  if (!options.denoise) return;
  const PassTimer::Scope timed(timer, "denoise");
  denoise(view, options, fullscreen);
}

void ScreenOcclusion::find_openness(const View& view, const OcclusionOptions& options,
                                    const Fullscreen& fullscreen) {
  if (options.method == OcclusionMethod::sao) draw_levels(fullscreen);
  const Program& chosen = program(options);
  openness_.bind();
  glDisable(GL_DEPTH_TEST);
  chosen.use();
  set_layer(chosen, geometry_.target(), view);
  set_options(chosen, options);
  if (options.method == OcclusionMethod::sao) {
    chosen.set_texture("depth_levels", first_technique_unit + 2, GL_TEXTURE_2D, levels_.colors[0]);
    chosen.set("last_level", small_levels(view.width, view.height));
  }
  fullscreen.draw();
}

void ScreenOcclusion::draw_levels(const Fullscreen& fullscreen) {
  const RenderTarget& layer = geometry_.target();
  const int levels = small_levels(layer.width, layer.height);
  if (levels == 0) return;
  if (!level_program_) level_program_ = Program("fullscreen.vert", "occlusion_mips.frag");
  const int width = layer.width >> 1, height = layer.height;
  fit(levels_, width, height, TexelFormat::r32f);
  levels_.bind();
  glDisable(GL_DEPTH_TEST);
  level_program_.use();
  level_program_.set_texture("depth_layer", first_technique_unit, GL_TEXTURE_2D, layer.colors[0]);
  level_program_.set("levels", levels);
  fullscreen.draw();
}

void ScreenOcclusion::denoise(const View& view, const OcclusionOptions& options,
                              const Fullscreen& fullscreen) {
  if (!denoise_program_) denoise_program_ = Program("fullscreen.vert", "occlusion_denoise.frag");
  fit(half_way_, view.width, view.height, TexelFormat::rgba16f);
  denoise_program_.use();
  set_layer(denoise_program_, geometry_.target(), view);
  denoise_program_.set("radius", options.radius_metres);
  denoise_program_.set("noise_scale", occlusion_noise_scale);
  for (int round = 0; round < 2; ++round) {
    (round == 0 ? half_way_ : openness_).bind();
    const RenderTarget& from = round == 0 ? openness_ : half_way_;
    denoise_program_.set_texture("noisy", first_technique_unit + 2, GL_TEXTURE_2D, from.colors[0]);
    denoise_program_.set("upwards", round);
    fullscreen.draw();
  }
}

void set_screen_occlusion(const Program& program, const ScreenOcclusion& occlusion, int unit) {
  program.set_texture("screen_openness", unit, GL_TEXTURE_2D, occlusion.openness().colors[0]);
}

}  // namespace welkin
