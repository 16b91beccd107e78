#include <welkin/realtime/techniques/bump_techniques.h>

#include <algorithm>
#include <cmath>

// What the techniques for normal maps aim at: the same shading at level 0 of the normal map, at very many points of each pixel's square.
// Slow; gets better from frame to frame.

namespace welkin {
namespace {

constexpr int largest_target = 2048, largest_scale = 8;

// Where frame n's samples lie in their cells, in [-0.5, 0.5)^2: additive recurrence by the plastic number (Roberts 2018), the first in
// the middle. Cells are alike, so all of a pixel's samples are stratified.
Vec2f place_in_cell(int n) {
  const auto turn = [n](double step) {
    const double x = 0.5 + step * n;
    return static_cast<float>(x - std::floor(x) - 0.5);
  };
  return {turn(0.7548776662466927), turn(0.5698402909980532)};
}

View shifted(const View& view, int scale, Vec2f offset) {
  View moved = view;
  moved.width = view.width * scale;
  moved.height = view.height * scale;
  Matrix4 shift;
  shift.m[12] = 2 * offset.x / static_cast<float>(moved.width);
  shift.m[13] = 2 * offset.y / static_cast<float>(moved.height);
  moved.view_to_clip = multiply(shift, view.view_to_clip);
  moved.world_to_clip = multiply(shift, view.world_to_clip);
  return moved;
}

class SupersampledTechnique : public Technique {
 public:
  bool progressive() const override { return true; }

  void draw(const Frame& frame, const ParameterValues& values) override {
    maps_.update(frame);
    fit(frame.target);
    if (frame.accumulated == 0) drawn_ = 0;
    const PassTimer::Scope timed(frame.timer, "samples");
    const int frames =
        std::max(1, static_cast<int>(std::ceil(values[0] / static_cast<float>(scale_ * scale_))));
    for (int i = 0; i < frames; ++i) add_samples(frame);
    frame.target.bind();
    draw_surfaces(frame, frame.view);  // for its depth
    show(frame);
  }

 private:
  void fit(const RenderTarget& target) {
    if (sums_[0].width == target.width && sums_[0].height == target.height) return;
    const int longest = std::max(target.width, target.height);
    scale_ = std::clamp(largest_target / longest, 1, largest_scale);
    constexpr TexelFormat format = TexelFormat::rgba32f;
    samples_ = {};
    samples_ = make_render_target(target.width * scale_, target.height * scale_, &format, 1, true);
    for (RenderTarget& sum : sums_) sum = make_render_target(target.width, target.height, &format, 1, false);
    drawn_ = 0;
  }

  void draw_surfaces(const Frame& frame, const View& view) {
    surfaces_.use();
    set_environment(surfaces_, frame.environment);
    surfaces_.set("mips", 0);
    draw_scene(surfaces_, frame.scene, view, &maps_);
  }

  void add_samples(const Frame& frame) {
    samples_.bind();
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_surfaces(frame, shifted(frame.view, scale_, place_in_cell(drawn_)));
    sums_[1].bind();
    glDisable(GL_DEPTH_TEST);
    add_.use();
    add_.set_texture("samples", first_technique_unit, GL_TEXTURE_2D, samples_.colors[0]);
    add_.set_texture("before", first_technique_unit + 1, GL_TEXTURE_2D, sums_[0].colors[0]);
    add_.set("scale", scale_);
    add_.set("first", drawn_ == 0 ? 1 : 0);
    frame.fullscreen.draw();
    std::swap(sums_[0], sums_[1]);
    ++drawn_;
  }

  void show(const Frame& frame) {
    show_.use();
    show_.set_texture("sum", first_technique_unit, GL_TEXTURE_2D, sums_[0].colors[0]);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // the triangle lies on the far plane: where there is a surface
    glDepthMask(GL_FALSE);
    frame.fullscreen.draw();
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
  }

  Program surfaces_{"mesh.vert", "bump_naive.frag"}, add_{"fullscreen.vert", "supersample_add.frag"},
      show_{"background.vert", "supersample_show.frag"};
  GpuBumpMaps maps_;
  RenderTarget samples_, sums_[2];
  int scale_ = 1, drawn_ = 0;
};

constexpr Parameter parameters[] = {{"samples", "a pixel and a frame", 1, 4096, 64, true, {}}};

constexpr TechniqueInfo table[] = {
    {"bump-supersampled", "level 0 of the normal map at very many points of a pixel: what the others aim at",
     "Cook 1986", Truth::unshadowed, parameters,
     []() -> std::unique_ptr<Technique> { return std::make_unique<SupersampledTechnique>(); }, nullptr}};

}  // namespace

std::span<const TechniqueInfo> bump_supersampled_techniques() { return table; }

}  // namespace welkin
