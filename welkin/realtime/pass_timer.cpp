#include <welkin/realtime/pass_timer.h>

#include <chrono>

namespace welkin {
namespace {

// EXT_disjoint_timer_query; the same numbers in EXT_disjoint_timer_query_webgl2.
constexpr GLenum time_elapsed = 0x88BF, gpu_disjoint = 0x8FBB;
// More frames than any driver keeps under way: a driver that never answers must not fill the memory.
constexpr std::size_t most_waiting = 8;

double now_milliseconds() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

bool has_extension(std::string_view wanted) {
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLint i = 0; i < count; ++i) {
    const auto* name = reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i)));
    if (name != nullptr && std::string_view(name) == wanted) return true;
  }
  return false;
}

}  // namespace

bool is_software_renderer(std::string_view gl_renderer) {
  for (const std::string_view software : {"llvmpipe", "softpipe", "SwiftShader", "SWR", "Software"})
    if (gl_renderer.find(software) != std::string_view::npos) return true;
  return false;
}

bool has_timer_queries() {
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (renderer == nullptr || is_software_renderer(renderer)) return false;
  return has_extension("GL_EXT_disjoint_timer_query") || has_extension("GL_EXT_disjoint_timer_query_webgl2");
}

void PassTimer::begin_stretch() {
  Stretch stretch;
  if (spare_.empty()) {
    stretch.query = GlQuery::make();
  } else {
    stretch.query = std::move(spare_.back());
    spare_.pop_back();
  }
  stretch.passes = open_;
  glBeginQuery(time_elapsed, stretch.query.name());
  current_.stretches.push_back(std::move(stretch));
}

void PassTimer::end_stretch() { glEndQuery(time_elapsed); }

// False: not all answers are there yet.
bool PassTimer::take_times(TimedFrame& frame) {
  for (const Stretch& stretch : frame.stretches) {
    GLuint there = 0;
    glGetQueryObjectuiv(stretch.query.name(), GL_QUERY_RESULT_AVAILABLE, &there);
    if (there == 0) return false;
  }
  for (Stretch& stretch : frame.stretches) {
    GLuint nanoseconds = 0;
    glGetQueryObjectuiv(stretch.query.name(), GL_QUERY_RESULT, &nanoseconds);
    for (const int pass : stretch.passes)
      frame.passes[static_cast<std::size_t>(pass)].milliseconds += 1e-6 * nanoseconds;
    spare_.push_back(std::move(stretch.query));
  }
  frame.stretches.clear();
  return true;
}

void PassTimer::collect() {
  if (waiting_.empty()) return;
  std::size_t done = 0;
  while (done < waiting_.size() && take_times(waiting_[done])) ++done;
  if (done == 0 && waiting_.size() < most_waiting) return;
  GLint disjoint = 0;  // the GPU's clock jumped: what was measured since it was last asked means nothing
  glGetIntegerv(gpu_disjoint, &disjoint);
  if (done > 0 && disjoint == 0) latest_ = std::move(waiting_[done - 1].passes);
  if (done == 0) done = 1;
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(done));
}

void PassTimer::begin_frame() {
  if (!current_.stretches.empty()) waiting_.push_back(std::move(current_));
  current_ = {};
  collect();
  if (!enabled) {
    waiting_.clear();
    latest_.clear();
    spare_.clear();
  }
}

const std::vector<PassTime>& PassTimer::passes() {
  if (mode == TimerMode::clock) return current_.passes;
  collect();
  return latest_;
}

PassTimer::Scope::Scope(PassTimer& timer, std::string_view name) : timer_(timer) {
  if (!timer_.enabled) return;
  pass_ = static_cast<int>(timer_.current_.passes.size());
  by_query_ = timer_.mode == TimerMode::queries;
  if (by_query_ && !timer_.open_.empty()) timer_.end_stretch();
  timer_.current_.passes.push_back({std::string(name), 0, static_cast<int>(timer_.open_.size())});
  timer_.open_.push_back(pass_);
  if (by_query_) {
    timer_.begin_stretch();
  } else {
    glFinish();
    start_ = now_milliseconds();
  }
}

PassTimer::Scope::~Scope() {
  if (pass_ < 0) return;
  timer_.open_.pop_back();
  if (by_query_) {
    timer_.end_stretch();
    if (!timer_.open_.empty()) timer_.begin_stretch();
    return;
  }
  glFinish();
  timer_.current_.passes[static_cast<std::size_t>(pass_)].milliseconds = now_milliseconds() - start_;
}

}  // namespace welkin
