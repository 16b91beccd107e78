#pragma once
#include <string>
#include <vector>

#include <welkin/image/byte_image.h>

struct GLFWwindow;

namespace welkin {

/// A window with an OpenGL ES 3.0 context, made current, and Dear ImGui in it. One at a time.
class Window {
 public:
  /// Throws Error in one line where there is no display, or no OpenGL ES 3.0 on it.
  Window(int width, int height, const char* title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Waits at most so long for something to happen, takes events and starts ImGui's frame.
  void begin_frame(double wait_seconds);
  void clear();
  /// Draws ImGui's frame over the framebuffer.
  void draw_controls();
  /// Shows it.
  void end_frame();

  bool should_close() const;
  void close();
  void set_title(const std::string& title);
  int framebuffer_width() const;  ///< pixels; 0 while it is minimised
  int framebuffer_height() const;
  float pixels_per_point() const;  ///< ImGui's coordinates are points
  /// Files that were dropped since the last call.
  std::vector<std::string> take_dropped_files();
  /// What end_frame will show: call it just before.
  ByteImage read_framebuffer() const;

 private:
  struct GlfwLife {
    GlfwLife();
    ~GlfwLife();
  };
  GlfwLife life_;
  GLFWwindow* window_ = nullptr;
  std::vector<std::string> dropped_;
};

}  // namespace welkin
