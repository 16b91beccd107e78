#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <welkin/realtime/gl/objects.h>

namespace welkin {

/// How long a pass took.
struct PassTime {
  std::string name;
  double milliseconds = 0;
};

/// Times the passes of a frame: on request by the clock around glFinish (right on every driver, but it keeps the processor and the GPU
/// from working side by side), else not at all.
class PassTimer {
 public:
  bool enabled = false;

  void begin_frame() { passes_.clear(); }
  const std::vector<PassTime>& passes() const { return passes_; }

  /// Times from its making to its end.
  class Scope {
   public:
    Scope(PassTimer& timer, std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PassTimer& timer_;
    std::string name_;
    double start_ = 0;
  };

 private:
  std::vector<PassTime> passes_;
};

}  // namespace welkin
