#include <welkin/realtime/capture/dynamic_light.h>

#include <algorithm>

#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

constexpr int irradiance_size = 32;

bool same(const Bounds& a, const Bounds& b) { return a.low == b.low && a.high == b.high; }

}  // namespace

void DynamicLight::prepare(const Frame& frame, const DynamicLightOptions& options) {
  const DynamicLightOptions& old = options_;
  const bool moved = !same(about_, frame.scene.bounds);
  if (!surroundings_ || moved || old.around != options.around || old.patches != options.patches)
    surroundings_.emplace(options.around, frame.scene.bounds, options.patches);
  const bool other_map = !capture_ || old.input != options.input || old.size != options.size;
  if (other_map) {
    capture_.reset();
    capture_.emplace(options.input, options.size);
  }
  if (other_map || old.projection != options.projection || old.degree != options.degree) {
    projector_.reset();
    projector_.emplace(capture_->shape(), options.degree, options.projection);
  }
  if (!irradiance_ || old.degree != options.degree)
    irradiance_.emplace(irradiance_size, cosine_lobe(options.degree));
  if (!around_) {
    around_ = Program("mesh.vert", "surroundings.frag");
    sky_program_ = Program("background.vert", "capture_sky.frag");
  }
  options_ = options;
  about_ = frame.scene.bounds;
}

void DynamicLight::capture_once(const Frame& frame, float ambient) {
  {
    const PassTimer::Scope timed(frame.timer, "capture");
    capture_->capture(*surroundings_, sky_, {&irradiance_->cube(), ambient}, frame.fullscreen);
  }
  {
    const PassTimer::Scope timed(frame.timer, "projection");
    projector_->project(capture_->map(), frame.fullscreen);
  }
  const PassTimer::Scope timed(frame.timer, "irradiance cube");
  irradiance_->draw(projector_->coefficients(), frame.fullscreen);
}

void DynamicLight::update(const Frame& frame, const DynamicLightOptions& options) {
  prepare(frame, options);
  surroundings_->move_to(frame.time_seconds, options.flare_radiance);
  sky_.kind = options.sky;
  sky_.environment = &frame.environment;
  // A disc of four texels across is captured with its light all there.
  GpuSkyOptions sky;
  sky.disc_radius = 5.0 / options.size;
  if (options.sky == 1) sky_.day = make_gpu_sky(sun_at(frame.time_seconds), sky);
  capture_once(frame, 0);
  for (int bounce = 0; bounce < options.bounces && options.around != SurroundingsKind::none; ++bounce)
    capture_once(frame, 1);
  drawn_ = true;
}

View DynamicLight::view_of(const Frame& frame) const {
  View view = frame.view;
  const float distance = length(view.eye - surroundings_->probe());
  view.far_metres = std::max(view.far_metres, 1.01f * (distance + surroundings_->reach_metres()));
  // An orthographic camera's rays start in the plane of its eye.
  view.near_metres = std::min(view.near_metres, view.orthographic ? 0.0f : 1e-3f * view.far_metres);
  const float n = view.near_metres, f = view.far_metres;
  view.view_to_clip.m[10] = view.orthographic ? 2 / (n - f) : (f + n) / (n - f);
  view.view_to_clip.m[14] = view.orthographic ? (f + n) / (n - f) : 2 * f * n / (n - f);
  view.world_to_clip = multiply(view.view_to_clip, view.world_to_view);
  return view;
}

void DynamicLight::draw_around(const Frame& frame, const View& view) {
  const PassTimer::Scope timed(frame.timer, "surroundings");
  draw_surroundings(around_, *surroundings_, {&irradiance_->cube(), options_.bounces > 0 ? 1.0f : 0.0f},
                    view);
  if (options_.sky == 0) return;  // the caller's background
  sky_program_.use();
  set_environment(sky_program_, frame.environment);
  set_sky(sky_program_, sky_.day);
  sky_program_.set("sky_kind", 1);
  sky_program_.set("ray_corner", view.orthographic ? view.forward : view.ray_corner);
  sky_program_.set("ray_right", view.orthographic ? Vec3f{} : view.ray_right);
  sky_program_.set("ray_up", view.orthographic ? Vec3f{} : view.ray_up);
  glDepthFunc(GL_LEQUAL);
  glDepthRangef(0, 0.999999f);  // nearer than the caller's background, which would cover it
  frame.fullscreen.draw();
  glDepthRangef(0, 1);
  glDepthFunc(GL_LESS);
}

}  // namespace welkin
