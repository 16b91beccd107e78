#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <imgui/imgui.h>

#include <welkin/error.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>
#include <welkin/parallel/parallel_for.h>

#include "overlays.h"
#include "panel.h"
#include "session.h"
#include "shortcuts.h"
#include "view_options.h"
#include "window.h"

// welkin-view: the window that `welkin view` opens.

namespace welkin {
namespace {

constexpr double idle_wait_seconds = 0.1;
// For scripts: drawing the same again and again would take the processor from what they wait for.
constexpr double scripted_wait_seconds = 0.02;

class Application {
 public:
  explicit Application(const ViewOptions& options)
      : options_(options), window_(options.width, options.height, "welkin"), session_(options) {
    state_.panel = options.panel;
    state_.help = options.help;
    if (has_timer_queries()) session_.viewer.renderer().timer().mode = TimerMode::queries;
  }

  int run() {
    while (!window_.should_close() && !state_.quit && !is_done()) frame();
    if (options_.frames > 0 && session_.had_error()) throw Error(session_.first_error());
    return 0;
  }

 private:
  using clock = std::chrono::steady_clock;

  bool is_done() const { return options_.frames > 0 && settled_frames_ >= options_.frames; }

  double seconds_since_last() {
    const clock::time_point now = clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return std::min(seconds, 0.5);
  }

  // Points of the window that the picture has: what the panel leaves, and half of a narrow window.
  Area picture_area() const {
    const float points = window_.pixels_per_point();
    const float width = static_cast<float>(window_.framebuffer_width()) / points;
    const float height = static_cast<float>(window_.framebuffer_height()) / points;
    const float left =
        state_.panel ? std::min(panel_width * ImGui::GetIO().FontGlobalScale, 0.5f * width) : 0.0f;
    return {left, 0, width - left, height};
  }

  // More than the renderer draws is enlarged.
  static int picture_pixels(float points, float pixels_per_point) {
    return std::min(static_cast<int>(points * pixels_per_point), max_picture_size);
  }

  void controls(const Area& area) {
    take_input(session_, state_, area.x, area.width, area.height);
    if (state_.panel) draw_panel(session_, area.x, area.height);
    draw_legend(session_, area);
    draw_split_names(session_, area);
    draw_status(session_, area);
    draw_help(state_.help, area);
  }

  void show(const Area& area) {
    const float points = window_.pixels_per_point();
    const int left = static_cast<int>(area.x * points);
    window_.clear();
    session_.viewer.show(0, {left, 0, window_.framebuffer_width() - left, window_.framebuffer_height()});
  }

  void frame() {
    window_.begin_frame(active_ ? 0 : options_.frames > 0 ? scripted_wait_seconds : idle_wait_seconds);
    for (const std::string& file : window_.take_dropped_files()) session_.drop(file);
    const Area area = picture_area();
    const float points = window_.pixels_per_point();
    controls(area);
    const bool changed = session_.update(picture_pixels(area.width, points),
                                         picture_pixels(area.height, points), seconds_since_last());
    show(area);
    window_.draw_controls();
    if (session_.is_settled()) ++settled_frames_;
    if (is_done() && !options_.screenshot.empty())
      write_file(options_.screenshot, encode_png(window_.read_framebuffer()));
    window_.end_frame();
    // ImGui needs a frame or two after an event, and what is animated or refined every one.
    quiet_frames_ =
        changed || ImGui::IsAnyMouseDown() || ImGui::GetIO().WantTextInput ? 0 : quiet_frames_ + 1;
    active_ = quiet_frames_ < 3;
  }

  ViewOptions options_;
  Window window_;
  Session session_;
  WindowState state_;
  clock::time_point last_ = clock::now();
  int settled_frames_ = 0, quiet_frames_ = 0;
  bool active_ = true;
};

int run(int argc, char** argv) {
  const ViewOptions options = parse_view_options(argc, argv);
  if (options.exit_code >= 0) return options.exit_code;
  set_thread_count(options.threads);
  try {
    return Application(options).run();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "welkin: not enough memory\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "welkin: %s\n", error.what());
  }
  return 1;
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) { return welkin::run(argc, argv); }
