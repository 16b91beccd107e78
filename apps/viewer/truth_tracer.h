#pragma once
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <welkin/comparison/truth.h>

namespace welkin {

/// What is to be traced.
struct TruthRequest {
  unsigned view_number = 0;
  TruthView view;
  std::shared_ptr<const EnvironmentData> light;
  PictureSize size;
};

/// So many samples of it.
struct TracedTruth {
  unsigned view_number = 0;
  Image radiance;  ///< 4 channels: and coverage
  double samples = 0;
  double relative_error = 0;  ///< standard error of the luminance, see PictureError::mean_relative_error
};

/// Path-traces the view that it was last asked for in a thread of its own, to more and more samples.
class TruthTracer {
 public:
  explicit TruthTracer(unsigned most_samples);
  ~TruthTracer();
  TruthTracer(const TruthTracer&) = delete;
  TruthTracer& operator=(const TruthTracer&) = delete;

  /// Ends what is under way.
  void request(TruthRequest request);
  void stop();
  /// The newest picture that was not taken yet.
  std::optional<TracedTruth> take();
  /// One line where the path tracer refused; empty else.
  std::string error() const;
  /// Whether more samples will come.
  bool busy() const;

 private:
  void run();
  void trace(const TruthRequest& request);
  bool cancelled() const;

  const unsigned most_samples_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<TruthRequest> next_;
  std::optional<TracedTruth> picture_;
  std::string error_;
  bool busy_ = false, cancel_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace welkin
