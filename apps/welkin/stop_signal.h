#pragma once
#include <exception>
#include <string>

// What Ctrl-C and its kin do: end at once, unless somebody has something to keep.

namespace welkin {

/// For SIGINT, SIGTERM and SIGHUP, unless they are ignored: remove temporary files, wipe the progress line, exit with
/// 128 + signal.
void handle_stop_signals();

/// As long as it lives the first such signal is only noted; a second one ends at once.
class StopLater {
 public:
  StopLater();
  ~StopLater();
  StopLater(const StopLater&) = delete;
  StopLater& operator=(const StopLater&) = delete;
  int signal_number() const;  ///< 0: none came
};

/// Thrown by a command that has put away what it had when the signal came; main prints the line and exits as above.
class Stopped : public std::exception {
 public:
  Stopped(int signal_number, std::string line) : signal_(signal_number), line_(std::move(line)) {}
  const char* what() const noexcept override { return line_.c_str(); }
  int signal_number() const { return signal_; }

 private:
  int signal_ = 0;
  std::string line_;
};

}  // namespace welkin
