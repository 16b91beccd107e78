#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

// Timing for the benchmarks. A figure is one line: best and median time, the error that was measured before the time
// was, the limit that the error must keep, and a yardstick of the same run.

namespace bench {

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Timing {
  double best = 0, median = 0;  // s
};

inline Timing timing_of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  return {seconds.front(), seconds[seconds.size() / 2]};
}

/// `runs` runs after one that warms caches and pages up.
template <class Work>
Timing measure(int runs, Work&& work) {
  work();
  std::vector<double> seconds(runs);
  for (double& s : seconds) s = seconds_of(work);
  return timing_of(std::move(seconds));
}

/// Prints figures and remembers whether any error was beyond its limit.
class Report {
 public:
  /// A line of headings or remarks.
  void note(const std::string& text) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
  }

  void figure(const std::string& what, Timing time, double error, double limit,
              const std::string& yardstick) {
    note(fmt::format("{:<40} {:>9} best {:>9} median   error {:.1e}{} {}", what, milliseconds(time.best),
                     milliseconds(time.median), error, mark(error, limit), yardstick));
  }

  /// An error without a time.
  void check(const std::string& what, double error, double limit) {
    note(fmt::format("{:<40} {:36} error {:.1e}{}", what, "", error, mark(error, limit)));
  }

  int exit_code() const { return failures_ == 0 ? 0 : 1; }

 private:
  static std::string milliseconds(double seconds) {
    return fmt::format("{:.{}f} ms", 1000 * seconds, seconds < 0.1 ? 2 : 0);
  }

  std::string mark(double error, double limit) {
    const bool good = error <= limit;  // false for NaN
    if (!good) ++failures_;
    return fmt::format(" ({} {:.0e}{}", good ? "<=" : "NOT <=", limit, good ? ")" : ") FAILED");
  }

  int failures_ = 0;
};

}  // namespace bench
