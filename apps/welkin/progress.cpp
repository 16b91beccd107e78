#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace welkin {

using std::chrono::duration;
using std::chrono::steady_clock;

std::string progress_text(const std::string& what, double share, double seconds) {
  const double done = std::clamp(share, 0.0, 1.0);
  if (done <= 0) return fmt::format("{}", what);
  return fmt::format("{} {:3.0f} %, {:.1f} s left", what, 100 * done, seconds * (1 - done) / done);
}

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(steady_clock::now()),
      last_(start_) {}

ProgressLine::~ProgressLine() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(double share) {
  const auto now = steady_clock::now();
  const double seconds = duration<double>(now - start_).count();
  if (!terminal_ || seconds < 0.5 || duration<double>(now - last_).count() < 0.1) return;
  last_ = now;
  shown_ = true;
  std::fputs(("\r\033[K" + progress_text(what_, share, seconds)).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace welkin
