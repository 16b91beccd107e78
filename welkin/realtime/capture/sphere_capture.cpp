#include <welkin/realtime/capture/sphere_capture.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

constexpr int ambient_unit = first_technique_unit, cube_unit = first_technique_unit;
constexpr const char* paraboloid_define = "#define PARABOLOID\n";

int full_chain(int size) {
  int levels = 1;
  while (size >> levels != 0) ++levels;
  return levels;
}

struct DepthRange {
  float near, far;
};

DepthRange depth_range(const Surroundings& surroundings) {
  return {0.002f * surroundings.reach_metres(), 2 * surroundings.reach_metres()};
}

void clear_target() {
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

void draw_surroundings(const Program& program, const Surroundings& surroundings,
                       const CaptureAmbient& ambient, const View& view) {
  if (surroundings.scene().draws.empty()) return;
  program.use();
  set_flares(program, surroundings.flares());
  program.set("ambient_map", ambient_unit);  // no other sampler's unit, whether it is read or not
  if (ambient.irradiance != nullptr) bind_texture(ambient_unit, GL_TEXTURE_CUBE_MAP, *ambient.irradiance);
  program.set("ambient_scale", ambient.irradiance != nullptr ? ambient.scale : 0.0f);
  draw_scene(program, surroundings.scene(), view);
}

SphereCapture::SphereCapture(CaptureInput input, int size)
    : input_(input), size_(size), levels_(full_chain(size)) {
  if (input == CaptureInput::paraboloid_warped) {
    surroundings_warped_ = Program("paraboloid.vert", "surroundings.frag", paraboloid_define);
    sky_warped_ = Program("background.vert", "capture_sky.frag", paraboloid_define);
  } else {
    TextureDesc desc;
    desc.width = size;
    desc.levels = levels_;
    cube_ = make_cube_texture(desc);
    depth_ = GlRenderbuffer::make();
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size, size);
    framebuffer_ = GlFramebuffer::make();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    surroundings_ = Program("mesh.vert", "surroundings.frag");
    sky_ = Program("background.vert", "capture_sky.frag");
  }
  if (input != CaptureInput::cube) {
    constexpr TexelFormat format = TexelFormat::rgba16f;
    paraboloids_ = make_render_target(2 * size, size, &format, 1, input == CaptureInput::paraboloid_warped);
  }
  if (input == CaptureInput::paraboloid) from_cube_ = Program("fullscreen.vert", "paraboloid_from_cube.frag");
  check_gl("making a capture");
}

MapShape SphereCapture::shape() const {
  return map_shape(input_ == CaptureInput::cube ? Mapping::cube : Mapping::dual_paraboloid, size_);
}

void SphereCapture::draw_sky(const Program& program, const CaptureSky& sky,
                             const Fullscreen& fullscreen) const {
  // A texel of a paraboloid is twice as wide as one of a cube's.
  const float texels = input_ == CaptureInput::paraboloid_warped ? 0.5f * static_cast<float>(size_)
                                                                 : static_cast<float>(size_);
  const float wider = static_cast<float>(sky.environment->environment_size) / texels;
  set_environment(program, *sky.environment);
  set_sky(program, sky.day);
  program.set("sky_kind", sky.kind);
  program.set("sky_level", std::max(0.0f, std::log2(wider)));
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  fullscreen.draw();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

void SphereCapture::draw_cube(const Surroundings& surroundings, const CaptureSky& sky,
                              const CaptureAmbient& ambient, const Fullscreen& fullscreen) {
  const DepthRange range = depth_range(surroundings);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glViewport(0, 0, size_, size_);
  for (int face = 0; face < 6; ++face) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                           GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), cube_.name(), 0);
    clear_target();
    const View view = make_cube_face_view(surroundings.probe(), face, size_, range.near, range.far);
    draw_surroundings(surroundings_, surroundings, ambient, view);
    sky_.use();
    sky_.set("ray_corner", view.ray_corner);
    sky_.set("ray_right", view.ray_right);
    sky_.set("ray_up", view.ray_up);
    draw_sky(sky_, sky, fullscreen);
  }
}

void SphereCapture::draw_warped(const Surroundings& surroundings, const CaptureSky& sky,
                                const CaptureAmbient& ambient, const Fullscreen& fullscreen) {
  const DepthRange range = depth_range(surroundings);
  paraboloids_.bind();
  clear_target();
  View view;
  view.eye = surroundings.probe();
  for (int side = 0; side < 2; ++side) {
    glViewport(side * size_, 0, size_, size_);
    const float sign = side == 0 ? 1.0f : -1.0f;
    surroundings_warped_.use();
    surroundings_warped_.set("paraboloid_side", sign);
    surroundings_warped_.set("near_metres", range.near);
    surroundings_warped_.set("far_metres", range.far);
    draw_surroundings(surroundings_warped_, surroundings, ambient, view);
    sky_warped_.use();
    sky_warped_.set("paraboloid_side", sign);
    draw_sky(sky_warped_, sky, fullscreen);
  }
}

void SphereCapture::capture(const Surroundings& surroundings, const CaptureSky& sky,
                            const CaptureAmbient& ambient, const Fullscreen& fullscreen) {
  if (input_ == CaptureInput::paraboloid_warped) {
    draw_warped(surroundings, sky, ambient, fullscreen);
  } else {
    draw_cube(surroundings, sky, ambient, fullscreen);
  }
  glDisable(GL_DEPTH_TEST);
  if (input_ == CaptureInput::paraboloid) {
    paraboloids_.bind();
    from_cube_.use();
    from_cube_.set_texture("cube", cube_unit, GL_TEXTURE_CUBE_MAP, cube_);
    from_cube_.set("size", static_cast<float>(size_));
    fullscreen.draw();
  }
  check_gl("capturing the surroundings");
}

SphereMap SphereCapture::read_map() const {
  if (input_ == CaptureInput::cube) return sphere_map_from_cube(read_cube(cube_, size_, 0));
  // read_pixels turns pictures over; this one's first row is the texture's.
  const Image turned = read_pixels(paraboloids_);
  SphereMap map = make_sphere_map(shape());
  for (int y = 0; y < map.image.height; ++y)
    for (int x = 0; x < map.image.width; ++x)
      std::copy_n(turned.at(x, map.image.height - 1 - y), 3, map.image.at(x, y));
  return map;
}

Cube SphereCapture::read_as_cube() const {
  if (input_ != CaptureInput::paraboloid_warped) return read_cube(cube_, size_, 0);
  return cube_from_sphere_map(resample(read_map(), map_shape(Mapping::cube, size_)));
}

}  // namespace welkin
