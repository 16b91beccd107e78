#include <welkin/realtime/gl/headless_context.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include <welkin/error.h>

namespace welkin {

struct HeadlessContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~Handles() {
    if (display == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
  }
};

namespace {

// The displays that need no window system, in the order of trying: Mesa's surfaceless one takes whatever driver there
// is; of the devices the first that starts is taken (drivers that know devices only, as NVIDIA's).
EGLDisplay open_display() {
  const auto platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  const auto query_devices =
      reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const auto started = [](EGLDisplay display) {
    return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
  };
  if (platform_display != nullptr && query_devices != nullptr) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
      for (EGLint i = 0; i < count; ++i) {
        const EGLDisplay display = platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
        if (started(display)) return display;
      }
    }
  }
  if (platform_display != nullptr) {
    const EGLDisplay display = platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (started(display)) return display;
  }
  return EGL_NO_DISPLAY;
}

EGLContext open_context(EGLDisplay display) {
  const EGLint config_wish[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, config_wish, &config, 1, &count) != EGL_TRUE || count == 0)
    return EGL_NO_CONTEXT;
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, version);
}

}  // namespace

HeadlessContext::HeadlessContext() : handles_(std::make_unique<Handles>()) {
  handles_->display = open_display();
  if (handles_->display == EGL_NO_DISPLAY)
    throw Error("OpenGL: EGL has no driver that works without a display (on Debian: libgl1-mesa-dri)");
  if (eglBindAPI(EGL_OPENGL_ES_API) == EGL_TRUE) handles_->context = open_context(handles_->display);
  if (handles_->context == EGL_NO_CONTEXT)
    throw Error("OpenGL: the driver has no OpenGL ES 3.0 (on Debian: libgl1-mesa-dri)");
  if (eglMakeCurrent(handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, handles_->context) != EGL_TRUE)
    throw Error("OpenGL: the driver needs a window to draw to; surfaceless contexts are not supported");
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace welkin
