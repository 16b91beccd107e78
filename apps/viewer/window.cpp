#include "window.h"

#include <GLES3/gl3.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include <welkin/error.h>

namespace welkin {
namespace {

constexpr const char* headless_way = "welkin frame draws the same pictures without a window";

std::string last_glfw_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

GLFWwindow* open_window(int width, int height, const char* title) {
  glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_ES_API);
  glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  glfwWindowHint(GLFW_ALPHA_BITS, 0);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  return glfwCreateWindow(width, height, title, nullptr, nullptr);
}

void start_imgui(GLFWwindow* window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::StyleColorsDark();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  float scale = 1;
  glfwGetWindowContentScale(window, &scale, nullptr);
  if (scale > 1) {
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui::GetIO().FontGlobalScale = scale;
  }
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 300 es");
}

// Debian's ImGui is built for desktop OpenGL too and asks an ES context for what that lacks; it is drawn all the same.
void drop_imgui_errors() {
  for (int i = 0; i < 64 && glGetError() != GL_NO_ERROR; ++i) {
  }
}

}  // namespace

Window::GlfwLife::GlfwLife() {
  if (glfwInit() != GLFW_TRUE)
    throw Error("no window can be opened (" + last_glfw_error() + "); " + headless_way);
}

Window::GlfwLife::~GlfwLife() { glfwTerminate(); }

Window::Window(int width, int height, const char* title) {
  window_ = open_window(width, height, title);
  if (window_ == nullptr)
    throw Error("no window with OpenGL ES 3.0 can be opened (" + last_glfw_error() + "); " + headless_way);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetDropCallback(window_, [](GLFWwindow* on, int count, const char** paths) {
    auto* self = static_cast<Window*>(glfwGetWindowUserPointer(on));
    self->dropped_.insert(self->dropped_.end(), paths, paths + count);
  });
  start_imgui(window_);
}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
}

void Window::begin_frame(double wait_seconds) {
  if (wait_seconds > 0)
    glfwWaitEventsTimeout(wait_seconds);
  else
    glfwPollEvents();
  ImGui_ImplOpenGL3_NewFrame();
  drop_imgui_errors();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Window::end_frame() { glfwSwapBuffers(window_); }

bool Window::should_close() const { return glfwWindowShouldClose(window_) != 0; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

int Window::framebuffer_width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width;
}

int Window::framebuffer_height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return height;
}

float Window::pixels_per_point() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return width > 0 ? static_cast<float>(framebuffer_width()) / static_cast<float>(width) : 1.0f;
}

std::vector<std::string> Window::take_dropped_files() {
  std::vector<std::string> files;
  files.swap(dropped_);
  return files;
}

void Window::clear() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, framebuffer_width(), framebuffer_height());
  glClearColor(0.08f, 0.08f, 0.09f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

void Window::draw_controls() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  drop_imgui_errors();
}

ByteImage Window::read_framebuffer() const {
  const int width = framebuffer_width(), height = framebuffer_height();
  std::vector<std::uint8_t> rgba(std::size_t{4} * width * height);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  ByteImage image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      std::copy_n(&rgba[4 * (static_cast<std::size_t>(height - 1 - y) * width + x)], 3, image.at(x, y));
  return image;
}

}  // namespace welkin
