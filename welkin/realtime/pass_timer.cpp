#include <welkin/realtime/pass_timer.h>

#include <chrono>

namespace welkin {
namespace {

double now_milliseconds() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace

PassTimer::Scope::Scope(PassTimer& timer, std::string_view name) : timer_(timer), name_(name) {
  if (!timer_.enabled) return;
  glFinish();
  start_ = now_milliseconds();
}

PassTimer::Scope::~Scope() {
  if (!timer_.enabled) return;
  glFinish();
  timer_.passes_.push_back({std::move(name_), now_milliseconds() - start_});
}

}  // namespace welkin
