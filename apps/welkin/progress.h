#pragma once
#include <chrono>
#include <string>

namespace welkin {

/// A line on standard error that says how far long work is and how long it will take; silent unless that is a
/// terminal, and for the first half second.
class ProgressLine {
 public:
  explicit ProgressLine(std::string what);
  ~ProgressLine();  ///< wipes the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// share of the work done, in [0, 1].
  void show(double share);

 private:
  std::string what_;
  bool terminal_ = false, shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

/// "filtering  43 %, 2.1 s left" from the share done and the seconds it took.
std::string progress_text(const std::string& what, double share, double seconds);

}  // namespace welkin
