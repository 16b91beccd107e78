#include "stop_signal.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include <welkin/image/output_file.h>

namespace welkin {
namespace {

std::atomic<bool> later{false};
std::atomic<int> noted{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// Files appear by renaming, so a killed run has nothing to undo but its temporary files.
extern "C" void stop(int signal_number) {
  if (later && noted.exchange(signal_number) == 0) return;
  remove_unfinished_files();
  constexpr char wipe_progress[] = "\r\033[K";
  if (::isatty(STDERR_FILENO)) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, wipe_progress, sizeof wipe_progress - 1);
  }
  ::_exit(128 + signal_number);
}

}  // namespace

// A file above the limit of its size is an error to report, as a full disk is, and no reason to die half-way. What nohup,
// or a shell for its jobs in the background, set to be ignored stays ignored.
void handle_stop_signals() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction inherited {};
    ::sigaction(signal_number, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) std::signal(signal_number, stop);
  }
}

StopLater::StopLater() {
  noted = 0;
  later = true;
}
StopLater::~StopLater() { later = false; }
int StopLater::signal_number() const { return noted; }

}  // namespace welkin
