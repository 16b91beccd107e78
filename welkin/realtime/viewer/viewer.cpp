#include <welkin/realtime/viewer/viewer.h>

#include <algorithm>
#include <cmath>

#include <welkin/error.h>
#include <welkin/realtime/viewer/exposure_meter.h>

namespace welkin {

struct Viewer::State {
  explicit State(const RendererOptions& with) : options(with), main(with) {}

  RendererOptions options;
  Renderer main;
  std::optional<Renderer> other;  // draws the reference technique
  Program compare{"fullscreen.vert", "compare.frag"};
  Fullscreen fullscreen;
  ExposureMeter meter;

  std::shared_ptr<const EnvironmentData> light;
  bool has_scene = false;
  int width = 0, height = 0;

  ViewerState applied;        // what the picture was drawn with
  TechniqueChoice last_good;  // that drew a frame without an error
  unsigned view = 1, drawn_view = 0;
  GlTexture truth;
  Image truth_pixels;       // 4 channels, row 0 the top
  unsigned other_view = 0;  // of `other`
  std::optional<DifferenceNumbers> numbers;
  bool measured = false;  // or tried to
  int draws_since_measured = 0;
  double automatic_scale = 1;
  float metered_ev = 0;

  void draw_main(ViewerState& wanted, bool changed);
  void draw_other(ViewerState& wanted, bool changed);
  void forget_numbers();
  bool measurement_is_due();
};

namespace {

constexpr int draws_between_measurements = 10;  // while the animation runs

bool same(const Affine& a, const Affine& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.origin == b.origin;
}

bool same(const Camera& a, const Camera& b) {
  return same(a.to_world, b.to_world) && a.vertical_field_radians == b.vertical_field_radians &&
         a.orthographic_height == b.orthographic_height;
}

bool same(const TechniqueChoice& a, const TechniqueChoice& b) {
  return a.technique == b.technique && a.values == b.values;
}

// What a page or a command line left out, and values that a table does not have.
void complete(TechniqueChoice& choice, std::string_view otherwise) {
  if (choice.technique == nullptr) choice.technique = &find_technique(otherwise);
  const auto parameters = choice.technique->parameters;
  for (std::size_t i = choice.values.size(); i < parameters.size(); ++i)
    choice.values.push_back(parameters[i].initial);
  choice.values.resize(parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    float& value = choice.values[i];
    const Parameter& p = parameters[i];
    value = std::isfinite(value) ? std::clamp(value, p.minimum, p.maximum) : p.initial;
    if (p.whole || !p.choices.empty()) value = std::round(value);
  }
}

bool is_power_of_two(int n) { return n > 0 && (n & (n - 1)) == 0; }

bool compares_technique(const ViewerState& state) {
  return state.comparison != Comparison::picture && state.reference == ReferenceKind::technique;
}

Image with_coverage(const Image& radiance) {
  Image image(radiance.width, radiance.height, 4);
  const std::size_t count = image.pixels.size() / 4;
  for (std::size_t i = 0; i < count; ++i) {
    const float* from = &radiance.pixels[i * static_cast<std::size_t>(radiance.channels)];
    for (int c = 0; c < 4; ++c)
      image.pixels[4 * i + static_cast<std::size_t>(c)] = c < radiance.channels ? from[c] : 1.0f;
  }
  return image;
}

Image upside_down(const Image& image) {
  Image turned(image.width, image.height, image.channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  for (int y = 0; y < image.height; ++y) std::copy_n(image.at(0, image.height - 1 - y), row, turned.at(0, y));
  return turned;
}

}  // namespace

Viewer::Viewer(const RendererOptions& options) : state_(std::make_unique<State>(options)) {}
Viewer::~Viewer() = default;

void Viewer::set_scene(Scene scene) {
  State& s = *state_;
  const OrbitCamera framed = frame_scene(scene);
  s.main.set_scene(std::move(scene));
  if (s.other) s.other->set_scene(s.main.scene());
  s.has_scene = true;
  state.camera = framed;
  ++s.view;
}

void Viewer::set_environment(std::shared_ptr<const EnvironmentData> light) {
  State& s = *state_;
  s.main.set_environment(light);
  if (s.other) s.other->set_environment(light);
  s.light = std::move(light);
  ++s.view;
}

void Viewer::resize(int width, int height) {
  State& s = *state_;
  if (width == s.width && height == s.height) return;
  s.main.resize(width, height);
  if (s.other) s.other->resize(width, height);
  s.width = width;
  s.height = height;
  ++s.view;
}

bool Viewer::has_scene() const { return state_->has_scene; }
bool Viewer::has_environment() const { return state_->light != nullptr; }

void Viewer::advance(double seconds) {
  if (state.animate) state.time_seconds += seconds;
}

namespace {

float proportion(int width, int height) {
  return height == 0 ? 1.0f : static_cast<float>(width) / static_cast<float>(height);
}

// Whether two states show the same, however it is compared and toned.
bool same_view(const ViewerState& a, const ViewerState& b, float width_over_height) {
  return same(a.technique, b.technique) && a.rotation_degrees == b.rotation_degrees &&
         a.time_seconds == b.time_seconds && a.background == b.background &&
         same(to_camera(a.camera, width_over_height), to_camera(b.camera, width_over_height));
}

void take_over(Renderer& renderer, const ViewerState& state, const Camera& camera) {
  renderer.set_camera(camera);
  renderer.set_rotation(state.rotation_degrees);
  renderer.set_time(state.time_seconds);
  renderer.show_background = state.background;
}

}  // namespace

bool Viewer::has_picture() const { return state_->drawn_view != 0; }

bool Viewer::is_current() const {
  const State& s = *state_;
  return s.drawn_view == s.view && same_view(state, s.applied, proportion(s.width, s.height));
}

bool Viewer::needs_draw() const {
  const State& s = *state_;
  if (!s.has_scene || !s.light || s.width == 0) return false;
  if (!is_current()) return true;
  if (state.comparison != Comparison::picture) {
    if (state.reference != s.applied.reference || (has_reference() && !s.measured)) return true;
    if (compares_technique(state) &&
        (!s.other || !same(state.reference_technique, s.applied.reference_technique) ||
         s.other->progressive()))
      return true;
  }
  return s.main.progressive();
}

void Viewer::draw() {
  State& s = *state_;
  if (!s.has_scene || !s.light || s.width == 0) return;
  complete(state.technique, "prefiltered-ggx");
  complete(state.reference_technique, "mirror");
  if (s.drawn_view == s.view && !same_view(state, s.applied, proportion(s.width, s.height))) ++s.view;
  const bool changed = s.drawn_view != s.view;
  if (changed) s.truth.reset();
  s.draw_main(state, changed);
  if (compares_technique(state)) s.draw_other(state, changed);
  const bool other_reference = state.reference != s.applied.reference ||
                               !same(state.reference_technique, s.applied.reference_technique);
  if (other_reference || (changed && !state.animate)) s.forget_numbers();
  s.applied = state;
  s.last_good = state.technique;
  s.drawn_view = s.view;
  if (changed || is_power_of_two(s.main.accumulated())) s.metered_ev = s.meter.measure(s.main.picture());
  if (state.comparison != Comparison::picture && has_reference() && s.measurement_is_due()) measure();
}

void Viewer::State::draw_main(ViewerState& wanted, bool changed) {
  try {
    if (drawn_view == 0 || !same(wanted.technique, applied.technique))
      main.set_technique(*wanted.technique.technique, wanted.technique.values);
    if (changed) take_over(main, wanted, to_camera(wanted.camera, proportion(width, height)));
    main.draw();
  } catch (const Error&) {
    // The renderer may have taken the new one over already: a change of the view makes it take the old one again.
    if (last_good.technique != nullptr) {
      applied.technique = wanted.technique;
      wanted.technique = last_good;
      ++view;
    }
    throw;
  }
}

void Viewer::State::draw_other(ViewerState& wanted, bool changed) {
  try {
    const bool anew = !other;
    if (anew) {
      other.emplace(options);
      other->set_scene(main.scene());
      other->set_environment(light);
      other->resize(width, height);
    }
    if (anew || !same(wanted.reference_technique, applied.reference_technique))
      other->set_technique(*wanted.reference_technique.technique, wanted.reference_technique.values);
    // A comparison that was left for a while has missed changes.
    if (anew || changed || other_view != view)
      take_over(*other, wanted, to_camera(wanted.camera, proportion(width, height)));
    other->draw();
    other_view = view;
  } catch (const Error&) {
    other.reset();
    wanted.comparison = Comparison::picture;
    throw;
  }
}

void Viewer::State::forget_numbers() {
  numbers.reset();
  measured = false;
}

bool Viewer::State::measurement_is_due() {
  if (!measured) return true;
  if (applied.animate) return ++draws_since_measured >= draws_between_measurements;
  return is_power_of_two(main.accumulated()) || (other && is_power_of_two(other->accumulated()));
}

std::optional<DifferenceNumbers> Viewer::measure() {
  State& s = *state_;
  s.measured = true;
  s.draws_since_measured = 0;
  s.numbers.reset();
  if (!has_reference()) return s.numbers;
  const bool by_truth = state.reference == ReferenceKind::truth;
  if (by_truth && (s.truth_pixels.width != s.width || s.truth_pixels.height != s.height)) return s.numbers;
  const Image picture = s.main.read_picture();
  s.numbers = measure_difference(picture, by_truth ? s.truth_pixels : s.other->read_picture());
  s.automatic_scale = nice_scale(s.numbers->p99);
  return s.numbers;
}

void Viewer::show(GLuint framebuffer, const Viewport& at) const {
  const State& s = *state_;
  if (s.drawn_view == 0 || at.width < 1 || at.height < 1) return;
  const DisplayOptions display{exposure_ev(), state.curve, state.white};
  if (state.comparison == Comparison::picture || !has_reference())
    return s.main.show(display, framebuffer, at.x, at.y, at.width, at.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(at.x, at.y, at.width, at.height);
  glDisable(GL_DEPTH_TEST);
  s.compare.use();
  s.compare.set_texture("picture", 0, GL_TEXTURE_2D, s.main.picture().colors[0]);
  s.compare.set_texture("reference", 1, GL_TEXTURE_2D,
                        state.reference == ReferenceKind::truth ? s.truth : s.other->picture().colors[0]);
  s.compare.set("exposure", std::exp2(display.exposure_ev));
  s.compare.set("curve", static_cast<int>(display.curve));
  s.compare.set("white", display.white);
  s.compare.set("mode", static_cast<int>(state.comparison));
  s.compare.set("split", state.split);
  s.compare.set("pixel", 1.0f / static_cast<float>(at.width));
  s.compare.set("scale", static_cast<float>(difference_scale()));
  const ColorScale& colors =
      state.comparison == Comparison::signed_difference ? signed_colors() : size_colors();
  std::vector<Vec3f> stops;
  for (const Rgb& c : colors) stops.push_back({c.r, c.g, c.b});
  s.compare.set_vec3_array("stops", stops);
  s.fullscreen.draw();
}

ByteImage Viewer::screenshot() const {
  const State& s = *state_;
  if (s.drawn_view == 0)
    throw Error("there is no picture yet: a scene, an environment and a size are needed");
  const TexelFormat format = TexelFormat::rgba8;
  const RenderTarget bytes = make_render_target(s.width, s.height, &format, 1, false);
  show(bytes.framebuffer.name(), {0, 0, s.width, s.height});
  return read_bytes(bytes);
}

unsigned Viewer::view_number() const { return state_->view; }

void Viewer::set_truth(const Image& radiance, unsigned view_number) {
  State& s = *state_;
  if (view_number != s.view || radiance.empty()) return;
  if (radiance.width > max_picture_size || radiance.height > max_picture_size || radiance.channels < 3)
    throw Error("the picture to compare with must have 3 or 4 channels and sides up to 4096");
  s.truth_pixels = with_coverage(radiance);
  TextureDesc desc;
  desc.format = TexelFormat::rgba32f;
  desc.linear = false;
  s.truth = upload_image(upside_down(s.truth_pixels), desc, false);
  s.measured = false;
}

bool Viewer::has_truth() const { return static_cast<bool>(state_->truth); }

bool Viewer::has_reference() const {
  const State& s = *state_;
  return state.reference == ReferenceKind::truth ? has_truth() : s.other && s.other->accumulated() > 0;
}

const std::optional<DifferenceNumbers>& Viewer::numbers() const { return state_->numbers; }

double Viewer::difference_scale() const {
  return state.difference_scale > 0 ? double{state.difference_scale} : state_->automatic_scale;
}

float Viewer::exposure_ev() const {
  return state.exposure_ev + (state.automatic_exposure ? state_->metered_ev : 0.0f);
}

Renderer& Viewer::renderer() { return state_->main; }
const Renderer& Viewer::renderer() const { return state_->main; }
const std::vector<PassTime>& Viewer::passes() { return state_->main.timer().passes(); }

}  // namespace welkin
