#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <welkin/error.h>
#include <welkin/realtime/viewer/viewer.h>
#include <welkin/scene/built_in.h>
#include <welkin/scene/gltf.h>

#include "packed_light.h"
#include "web_calls.h"

// What the page calls: one viewer on the context that JavaScript made current. When a context is lost the viewer goes and
// what it showed is kept, for the next one.

namespace welkin {
namespace {

std::string last_error, last_text;
std::unique_ptr<Viewer> viewer;
Scene scene;
bool has_scene = false;
std::shared_ptr<const EnvironmentData> light;
std::optional<ViewerState> kept_state;
int width = 0, height = 0;
GltfPictures pictures;

Viewer& running() {
  if (!viewer) throw Error("there is no WebGL context");
  return *viewer;
}

void show_scene(Scene next) {
  running().set_scene(next);
  scene = std::move(next);
  has_scene = true;
}

void choose(TechniqueChoice& choice, std::string_view text) { choice = parse_technique(text); }

int index_of(std::span<const std::string_view> names, std::string_view name, const char* what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(fmt::format("no {} is called {}", what, name));
  return static_cast<int>(found - names.begin());
}

void set(ViewerState& state, std::string_view key, std::string_view text) {
  if (key == "technique") return choose(state.technique, text);
  if (key == "reference") return choose(state.reference_technique, text);
  if (key == "comparison") {
    state.reference = ReferenceKind::technique;
    state.comparison = static_cast<Comparison>(index_of(comparison_names, text, "comparison"));
  } else if (key == "curve") {
    state.curve = static_cast<ToneCurve>(index_of(curve_names, text, "tone curve"));
  } else {
    throw Error(fmt::format("there is no setting {}", key));
  }
}

void set(ViewerState& state, std::string_view key, float value) {
  if (!std::isfinite(value)) throw Error(fmt::format("{} must be a finite number", key));
  if (key == "rotation")
    state.rotation_degrees = value;
  else if (key == "exposure")
    state.exposure_ev = value;
  else if (key == "automatic-exposure")
    state.automatic_exposure = value != 0;
  else if (key == "background")
    state.background = value != 0;
  else if (key == "animate")
    state.animate = value != 0;
  else if (key == "time")
    state.time_seconds = static_cast<double>(value);
  else if (key == "split")
    state.split = std::clamp(value, 0.0f, 1.0f);
  else if (key == "timing")
    running().renderer().timer().enabled = value != 0;
  else
    throw Error(fmt::format("there is no setting {}", key));
}

std::string numbers_json(Viewer& v) {
  const auto& n = v.numbers();
  if (!n) return "null";
  return fmt::format(R"({{"rms":{:.6g},"relativeRms":{:.6g},"mean":{:.6g},"largest":{:.6g},"scale":{:.6g}}})",
                     n->rms, n->relative_rms, n->mean, n->largest, v.difference_scale());
}

std::string passes_json(Viewer& v) {
  std::string list;
  for (const PassTime& pass : v.passes())
    list += fmt::format(R"({}{{"name":"{}","milliseconds":{:.4f},"depth":{}}})", list.empty() ? "" : ",",
                        pass.name, pass.milliseconds, pass.depth);
  return '[' + list + ']';
}

}  // namespace

const char* give_text(std::string text) {
  last_text = std::move(text);
  return last_text.c_str();
}

void set_last_error(const std::string& message) { last_error = message; }

}  // namespace welkin

using namespace welkin;

extern "C" {

EMSCRIPTEN_KEEPALIVE const char* welkin_error() { return last_error.c_str(); }

/// Makes the viewer on the current context, with what an earlier one showed.
EMSCRIPTEN_KEEPALIVE int welkin_start() {
  return succeeds([] {
    viewer = std::make_unique<Viewer>();
    if (has_scene) viewer->set_scene(scene);
    if (light) viewer->set_environment(light);
    if (kept_state) viewer->state = *kept_state;
    if (width > 0) viewer->resize(width, height);
  });
}

/// Before the context goes, or when it is lost.
EMSCRIPTEN_KEEPALIVE void welkin_stop() {
  if (viewer) kept_state = viewer->state;
  viewer.reset();
}

EMSCRIPTEN_KEEPALIVE int welkin_living_objects() {
  int count = 0;
  for (const int living : living_gl_objects()) count += living;
  return count;
}

EMSCRIPTEN_KEEPALIVE int welkin_resize(int w, int h) {
  return succeeds([&] {
    running().resize(w, h);
    width = w, height = h;
  });
}

EMSCRIPTEN_KEEPALIVE int welkin_set_light(const unsigned char* bytes, int count) {
  return succeeds([&] {
    auto next = unpack_light(std::span(bytes, static_cast<std::size_t>(count)));
    running().set_environment(next);
    light = std::move(next);
  });
}

EMSCRIPTEN_KEEPALIVE int welkin_built_in_scene(const char* name) {
  return succeeds([&] { show_scene(make_built_in_scene(name)); });
}

/// width * height RGBA bytes, straight alpha: the image `index` of the glTF file that is loaded next.
EMSCRIPTEN_KEEPALIVE int welkin_add_picture(int index, const unsigned char* rgba, int w, int h) {
  return succeeds([&] {
    ByteImage picture(w, h, 4);
    std::copy_n(rgba, picture.pixels.size(), picture.pixels.begin());
    pictures[index] = std::move(picture);
  });
}

/// The bytes of a .glb or a .gltf whose buffers are inside.
EMSCRIPTEN_KEEPALIVE int welkin_load_scene(const unsigned char* bytes, int count, const char* name) {
  const GltfPictures decoded = std::move(pictures);
  pictures.clear();
  return succeeds([&] {
    const auto refuse = [](const std::string& reference) -> std::vector<std::uint8_t> {
      throw Error("the page takes one file; " + reference + " is another: use a .glb");
    };
    show_scene(decode_gltf(std::span(bytes, static_cast<std::size_t>(count)), name, refuse, decoded));
  });
}

EMSCRIPTEN_KEEPALIVE int welkin_set_number(const char* key, double value) {
  return succeeds([&] { set(running().state, std::string_view(key), static_cast<float>(value)); });
}

EMSCRIPTEN_KEEPALIVE int welkin_set_text(const char* key, const char* value) {
  return succeeds([&] { set(running().state, std::string_view(key), std::string_view(value)); });
}

/// Movements in fractions of the canvas' height, x rightwards, y upwards.
EMSCRIPTEN_KEEPALIVE int welkin_orbit(double x, double y) {
  return succeeds([&] { orbit(running().state.camera, {static_cast<float>(x), static_cast<float>(y)}); });
}
EMSCRIPTEN_KEEPALIVE int welkin_pan(double x, double y) {
  return succeeds([&] { pan(running().state.camera, {static_cast<float>(x), static_cast<float>(y)}); });
}
EMSCRIPTEN_KEEPALIVE int welkin_zoom(double factor) {
  return succeeds([&] { zoom(running().state.camera, static_cast<float>(factor)); });
}
EMSCRIPTEN_KEEPALIVE int welkin_frame_scene() {
  return succeeds([] { running().state.camera = frame_scene(scene); });
}

EMSCRIPTEN_KEEPALIVE int welkin_needs_draw() { return viewer && viewer->needs_draw() ? 1 : 0; }

/// Draws what has changed and shows it on the canvas.
EMSCRIPTEN_KEEPALIVE int welkin_frame(double seconds) {
  return succeeds([&] {
    Viewer& v = running();
    v.advance(seconds);
    if (v.needs_draw()) v.draw();
    v.show(0, {0, 0, width, height});
  });
}

/// {"passes": [...], "numbers": {...}, "exposure": ..., "accumulated": ...}
EMSCRIPTEN_KEEPALIVE const char* welkin_report() {
  if (!viewer) return give_text("{}");
  return give_text(fmt::format(R"({{"passes":{},"numbers":{},"exposure":{:.3f},"accumulated":{}}})",
                               passes_json(*viewer), numbers_json(*viewer), viewer->exposure_ev(),
                               viewer->renderer().accumulated()));
}

/// What was drawn last: width * height * 3 bytes as shown, row 0 the top; null where there is nothing.
EMSCRIPTEN_KEEPALIVE const unsigned char* welkin_screenshot() {
  static ByteImage shot;
  return succeeds([] { shot = running().screenshot(); }) ? shot.pixels.data() : nullptr;
}
}
