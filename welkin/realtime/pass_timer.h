#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <welkin/realtime/gl/objects.h>

namespace welkin {

/// How long a pass took, the passes within it included.
struct PassTime {
  std::string name;
  double milliseconds = 0;
  int depth = 0;  ///< how many passes it lies within
};

enum class TimerMode {
  clock,  ///< around glFinish: right on every driver, but it keeps the processor and the GPU from working side by side
  queries,  ///< the GPU's own clock (EXT_disjoint_timer_query): costs next to nothing and comes some frames later. See has_timer_queries().
};

/// Times the passes of a frame, in the order in which they began, if enabled.
class PassTimer {
 public:
  bool enabled = false;
  TimerMode mode = TimerMode::clock;  ///< set it between frames

  /// What is timed from now on belongs to the next frame.
  void begin_frame();
  /// clock: of the frame under way; queries: of the last frame whose times have arrived.
  const std::vector<PassTime>& passes();

  /// Times from its making to its end. May lie within others of the same timer.
  class Scope {
   public:
    Scope(PassTimer& timer, std::string_view name);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    PassTimer& timer_;
    int pass_ = -1;  ///< in the frame under way; -1: not timed
    double start_ = 0;
    bool by_query_ = false;
  };

 private:
  // Queries cannot lie within each other, so a pass is the sum of the stretches between any two beginnings and ends.
  struct Stretch {
    GlQuery query;
    std::vector<int> passes;  // that it belongs to
  };
  struct TimedFrame {
    std::vector<PassTime> passes;
    std::vector<Stretch> stretches;
  };
  void begin_stretch();
  void end_stretch();
  void collect();
  bool take_times(TimedFrame& frame);

  TimedFrame current_;
  std::vector<TimedFrame> waiting_;  // oldest first
  std::vector<PassTime> latest_;
  std::vector<int> open_;  // passes under way, outermost first
  std::vector<GlQuery> spare_;
};

/// Whether the current context has timer queries and a driver whose answers mean something: software ones (llvmpipe) give the
/// time at which commands were recorded.
bool has_timer_queries();

/// Whether this GL_RENDERER is one that draws on the processor.
bool is_software_renderer(std::string_view gl_renderer);

}  // namespace welkin
