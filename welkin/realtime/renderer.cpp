#include <welkin/realtime/renderer.h>

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <welkin/error.h>

namespace welkin {

struct Renderer::State {
  RendererOptions options;
  Scene source, prepared;
  std::optional<GpuScene> scene;
  std::shared_ptr<const EnvironmentData> light;
  GpuEnvironment environment;
  float rotation_radians = 0;
  const TechniqueInfo* info = nullptr;
  std::unique_ptr<Technique> technique;
  ParameterValues values;
  Camera camera;
  RenderTarget picture;
  Program background, tone_map;
  Fullscreen fullscreen;
  PassTimer timer;
  double time_seconds = 0;
  int accumulated = 0;
};

namespace {

Scene prepared_for(const Scene& source, const TechniqueInfo* info) {
  Scene scene = source;
  if (info != nullptr && info->prepare_scene != nullptr) info->prepare_scene(scene);
  return scene;
}

void draw_background(const Program& program, const GpuEnvironment& environment, const View& view,
                     const Fullscreen& fullscreen) {
  program.use();
  set_environment(program, environment);
  program.set("ray_corner", view.orthographic ? view.forward : view.ray_corner);
  program.set("ray_right", view.orthographic ? Vec3f{} : view.ray_right);
  program.set("ray_up", view.orthographic ? Vec3f{} : view.ray_up);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);  // the triangle lies on the far plane
  glDepthMask(GL_FALSE);
  fullscreen.draw();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

}  // namespace

Renderer::Renderer(const RendererOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->background = Program("background.vert", "background.frag");
  state_->tone_map = Program("fullscreen.vert", "tone_map.frag");
}

Renderer::~Renderer() = default;

void Renderer::set_scene(Scene scene) {
  Scene prepared = prepared_for(scene, state_->info);
  state_->scene = upload_scene(prepared);  // where it throws, the scene before stays
  state_->source = std::move(scene);
  state_->prepared = std::move(prepared);
  state_->accumulated = 0;
}

void Renderer::set_environment(std::shared_ptr<const EnvironmentData> light) {
  state_->environment = upload_environment(light->maps, state_->options.environment, light->law);
  state_->light = std::move(light);
  state_->environment.rotation_radians = state_->rotation_radians;
  state_->accumulated = 0;
}

void Renderer::set_rotation(float degrees) {
  state_->rotation_radians = degrees * std::numbers::pi_v<float> / 180;
  state_->environment.rotation_radians = state_->rotation_radians;
  state_->accumulated = 0;
}

void Renderer::set_technique(const TechniqueInfo& technique, ParameterValues values) {
  if (state_->info != &technique || !state_->technique) {
    const auto before = state_->info != nullptr ? state_->info->prepare_scene : nullptr;
    state_->technique = technique.make();  // where it throws, the technique before stays
    state_->info = &technique;
    if (state_->scene && before != technique.prepare_scene) set_scene(state_->source);
  }
  state_->values = std::move(values);
  state_->accumulated = 0;
}

void Renderer::set_camera(const Camera& camera) {
  state_->camera = camera;
  state_->accumulated = 0;
}

void Renderer::resize(int width, int height) {
  if (width < 1 || height < 1 || width > max_picture_size || height > max_picture_size)
    throw Error(fmt::format("a picture of {} x {} pixels cannot be drawn: each side is 1 to {}", width,
                            height, max_picture_size));
  if (state_->picture.width == width && state_->picture.height == height) return;
  state_->picture = {};
  state_->picture = make_render_target(width, height, &state_->options.picture, 1, true);
  state_->accumulated = 0;
}

void Renderer::set_time(double seconds) {
  if (seconds != state_->time_seconds) state_->accumulated = 0;
  state_->time_seconds = seconds;
}

const Scene& Renderer::scene() const { return state_->source; }
const Scene& Renderer::prepared_scene() const { return state_->prepared; }
const TechniqueInfo& Renderer::technique() const { return *state_->info; }
float Renderer::rotation_degrees() const {
  return state_->rotation_radians * 180 / std::numbers::pi_v<float>;
}
const ParameterValues& Renderer::values() const { return state_->values; }
const Camera& Renderer::camera() const { return state_->camera; }
int Renderer::accumulated() const { return state_->accumulated; }
bool Renderer::progressive() const {
  return state_->technique != nullptr && state_->technique->progressive();
}
const RenderTarget& Renderer::picture() const { return state_->picture; }
Image Renderer::read_picture() const { return read_pixels(state_->picture); }
Cube Renderer::captured_environment() const {
  return state_->technique ? state_->technique->captured_environment() : Cube{};
}
PassTimer& Renderer::timer() { return state_->timer; }

void Renderer::draw() {
  State& s = *state_;
  if (!s.scene || !s.light || !s.technique || s.picture.width == 0)
    throw Error("the renderer needs a scene, an environment, a technique and a size before it can draw");
  s.timer.begin_frame();
  const View view = make_view(s.camera, s.picture.width, s.picture.height, s.scene->bounds);
  s.picture.bind();
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const Frame frame{*s.scene,  s.prepared,   *s.light, s.environment,  view,
                    s.picture, s.fullscreen, s.timer,  s.time_seconds, s.accumulated};
  s.technique->draw(frame, s.values);
  s.picture.bind();
  if (show_background) {
    const PassTimer::Scope timed(s.timer, "background");
    draw_background(s.background, s.environment, view, s.fullscreen);
  }
  ++s.accumulated;
  check_gl("drawing a frame");
}

void Renderer::show(const DisplayOptions& options, GLuint framebuffer, int x, int y, int width,
                    int height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(x, y, width, height);
  glDisable(GL_DEPTH_TEST);
  const Program& program = state_->tone_map;
  program.use();
  program.set_texture("picture", 0, GL_TEXTURE_2D, state_->picture.colors[0]);
  program.set("exposure", std::exp2(options.exposure_ev));
  program.set("curve", static_cast<int>(options.curve));
  program.set("white", options.white);
  state_->fullscreen.draw();
}

std::shared_ptr<const EnvironmentData> make_environment_data(Image radiance, IblOptions options) {
  options.kernel = KernelKind::ggx;
  options.law = LevelLaw::linear;
  options.dfg_form = DfgForm::scale_bias;
  options.sh_degree = std::max(options.sh_degree, 2);
  auto data = std::make_shared<EnvironmentData>();
  data->maps = make_ibl(radiance, options);
  data->radiance = std::move(radiance);
  return data;
}

}  // namespace welkin
