#pragma once
#include <memory>
#include <string>

namespace welkin {

/// An OpenGL ES 3 context without a window or a display (EGL: surfaceless, else a device), current in the thread that
/// made it until it is destroyed. Native only: the browser brings its own. One at a time in a thread.
class HeadlessContext {
 public:
  /// Throws Error saying what EGL lacks, where no OpenGL ES 3.0 driver can be started.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace welkin
