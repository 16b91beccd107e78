#include "session.h"

#include <exception>
#include <filesystem>

#include <fmt/format.h>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/load.h>
#include <welkin/image/output_file.h>

namespace welkin {
namespace {

// Dragging a view would start a path tracer with every frame.
constexpr double quiet_before_tracing = 0.3;
constexpr double message_seconds = 8, error_seconds = 60;

}  // namespace

Session::Session(const ViewOptions& options)
    : viewer({TexelFormat::rgba32f, TexelFormat::rgba16f}),
      options_(options),
      loader_(options.map_size),
      tracer_(options.truth_samples) {
  ViewerState& state = viewer.state;
  state.technique = options.technique;
  state.reference_technique = options.against;
  state.reference = options.reference;
  state.comparison = options.comparison;
  state.rotation_degrees = options.rotation_degrees;
  state.automatic_exposure = !options.exposure_ev;
  state.exposure_ev = options.exposure_ev.value_or(0.0f);
  state.curve = options.curve;
  if (!options.reference_file.empty()) use_stored_truth();
  load(LoadKind::scene, options.scene);
  load(LoadKind::environment, options.environment);
}

void Session::say(std::string text, bool is_error) {
  if (is_error && !had_error_) first_error_ = text;
  had_error_ = had_error_ || is_error;
  message_ = {std::move(text), is_error, is_error ? error_seconds : message_seconds};
}

void Session::use_stored_truth() {
  try {
    stored_truth_ = load_image(options_.reference_file).flat;
    if (stored_truth_.empty()) throw Error(options_.reference_file, "is a cube map, not a picture");
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Session::load(LoadKind kind, const std::string& name) { loader_.request(kind, name); }

// What cannot be read at the start leaves nothing to look at: the built-in ones take its place.
void Session::fall_back(LoadKind kind) {
  if (kind == LoadKind::scene && !viewer.has_scene() && options_.scene != "spheres") load(kind, "spheres");
  if (kind == LoadKind::environment && !viewer.has_environment() && options_.environment != "sky:")
    load(kind, "sky:");
}

void Session::take_loaded() {
  std::optional<Loaded> loaded = loader_.take();
  if (!loaded) return;
  failed_.reset();  // another scene or light may do
  try {
    if (!loaded->error.empty()) throw Error(loaded->error);
    if (loaded->kind == LoadKind::scene) {
      viewer.set_scene(std::move(*loaded->scene));
      scene_name_ = loaded->name;
    } else {
      viewer.set_environment(loaded->light);
      light_ = loaded->light;
      environment_name_ = loaded->name;
    }
    if (!loaded->warnings.empty()) say(loaded->name + ": " + loaded->warnings.front(), false);
  } catch (const std::exception& error) {
    say(error.what(), true);
    fall_back(loaded->kind);
  }
}

bool Session::Attempt::operator==(const Attempt& other) const {
  return technique.technique == other.technique.technique && technique.values == other.technique.values &&
         comparison == other.comparison;
}

void Session::draw(int width, int height) {
  const Attempt tried = attempt();
  try {
    viewer.resize(width, height);
    changed_ = viewer.needs_draw();
    if (changed_ && !has_failed()) viewer.draw();
    if (viewer.has_picture()) failed_.reset();
  } catch (const std::exception& error) {
    say(error.what(), true);
    // The viewer went back to what worked; where nothing did, the same error must not come with every frame.
    if (!viewer.has_picture()) failed_ = tried;
  }
}

bool Session::update(int width, int height, double seconds) {
  take_loaded();
  if (message_.seconds_left > 0) message_.seconds_left -= seconds;
  viewer.advance(seconds);
  changed_ = false;
  if (width > 0 && height > 0) draw(width, height);
  follow_truth(seconds);
  return changed_;
}

bool Session::wants_truth() const {
  return viewer.has_picture() && viewer.state.comparison != Comparison::picture &&
         viewer.state.reference == ReferenceKind::truth && stored_view_ != viewer.view_number() &&
         untraced_view_ != viewer.view_number();
}

bool Session::is_settled() const {
  if (loader_.work()) return false;
  if (!viewer.has_picture()) return has_failed();
  if (!viewer.is_current()) return false;
  return !wants_truth() || !tracer_.error().empty() || (viewer.has_truth() && !tracer_.busy());
}

void Session::request_truth() {
  const Renderer& renderer = viewer.renderer();
  const PictureSize size{renderer.picture().width, renderer.picture().height};
  const unsigned view = viewer.view_number();
  truth_samples_ = truth_error_ = 0;
  try {
    tracer_.request({view, truth_view(renderer), light_, size});
    traced_view_ = view;
  } catch (const std::exception& error) {  // of reading back what a technique captured
    say(error.what(), true);
    untraced_view_ = view;
  }
}

void Session::follow_truth(double seconds) {
  if (!viewer.has_picture() || !viewer.is_current()) return;
  const unsigned view = viewer.view_number();
  quiet_seconds_ = view == seen_view_ ? quiet_seconds_ + seconds : 0;
  seen_view_ = view;
  if (!stored_truth_.empty() && stored_view_ == 0) stored_view_ = view;
  if (stored_view_ == view && !viewer.has_truth()) viewer.set_truth(stored_truth_, view);
  const bool wanted = wants_truth();
  if (!wanted || (traced_view_ != 0 && traced_view_ != view)) {
    if (traced_view_ != 0) tracer_.stop();
    traced_view_ = 0;
  }
  if (!wanted) return;
  if (traced_view_ == 0 && quiet_seconds_ >= quiet_before_tracing) request_truth();
  if (const std::string error = tracer_.error(); !error.empty() && traced_view_ == view)
    return say(error, true);
  if (const std::optional<TracedTruth> picture = tracer_.take()) {
    viewer.set_truth(picture->radiance, picture->view_number);
    truth_samples_ = picture->samples;
    truth_error_ = picture->relative_error;
  }
}

Session::TruthStatus Session::truth_status() const {
  TruthStatus status;
  status.stored = stored_view_ != 0 && stored_view_ == viewer.view_number();
  status.samples = viewer.has_truth() ? truth_samples_ : 0;
  status.relative_error = truth_error_;
  status.busy = traced_view_ != 0 && tracer_.busy();
  return status;
}

void Session::save_picture() {
  try {
    for (int number = 1;; ++number) {
      const std::string name = fmt::format("welkin-{:03}.png", number);
      if (std::filesystem::exists(name)) continue;
      write_file(name, encode_png(viewer.screenshot()));
      return say("the picture is in " + name, false);
    }
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

}  // namespace welkin
