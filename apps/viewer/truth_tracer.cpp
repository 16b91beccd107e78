#include "truth_tracer.h"

#include <algorithm>
#include <exception>

#include <welkin/pathtrace/picture.h>

namespace welkin {
namespace {

TracedTruth picture_of(const PictureState& state, unsigned view_number) {
  TracedTruth picture;
  picture.view_number = view_number;
  const PictureError error = picture_error(state);
  picture.samples = error.mean_samples;
  picture.relative_error = error.mean_relative_error;
  const Image radiance = picture_radiance(state);
  picture.radiance = Image(state.size.width, state.size.height, 4);
  for (std::size_t i = 0; i < state.count.size(); ++i) {
    std::copy_n(&radiance.pixels[3 * i], 3, &picture.radiance.pixels[4 * i]);
    const auto count = static_cast<float>(std::max(1u, state.count[i]));
    picture.radiance.pixels[4 * i + 3] = state.coverage_sum[i] / count;
  }
  return picture;
}

}  // namespace

TruthTracer::TruthTracer(unsigned most_samples) : most_samples_(most_samples), thread_([this] { run(); }) {}

TruthTracer::~TruthTracer() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = cancel_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void TruthTracer::request(TruthRequest request) {
  {
    const std::lock_guard lock(mutex_);
    next_ = std::move(request);
    picture_.reset();
    error_.clear();
    cancel_ = true;
  }
  wake_.notify_one();
}

void TruthTracer::stop() {
  const std::lock_guard lock(mutex_);
  next_.reset();
  picture_.reset();
  cancel_ = true;
}

std::optional<TracedTruth> TruthTracer::take() {
  const std::lock_guard lock(mutex_);
  std::optional<TracedTruth> taken;
  taken.swap(picture_);
  return taken;
}

std::string TruthTracer::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

bool TruthTracer::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_ || next_.has_value();
}

bool TruthTracer::cancelled() const {
  const std::lock_guard lock(mutex_);
  return cancel_;
}

void TruthTracer::trace(const TruthRequest& request) {
  const EnvironmentSampler sky(truth_radiance(request.view, *request.light));
  const RenderScene ready(request.view.scene, &sky);
  PictureOptions options;
  options.size = request.size;
  options.integrator = truth_integrator(request.view);
  PictureState state = make_picture_state(request.size);
  // 8 samples, then half as many again each time: pictures come often at first, and reading them out costs little in all.
  for (unsigned samples = picture_replicates; samples <= most_samples_;) {
    options.samples = samples;
    if (!render_picture(state, ready, request.view.camera, options,
                        [this](const PictureProgress&) { return !cancelled(); }))
      return;
    TracedTruth picture = picture_of(state, request.view_number);
    const std::lock_guard lock(mutex_);
    if (cancel_) return;
    picture_ = std::move(picture);
    if (samples == most_samples_) return;
    samples = std::min(most_samples_, (samples + std::max(samples / 2, 8u)) / 8 * 8);
  }
}

void TruthTracer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [&] { return stop_ || next_.has_value(); });
    if (stop_) return;
    const TruthRequest request = std::move(*next_);
    next_.reset();
    cancel_ = false;
    busy_ = true;
    lock.unlock();
    std::string error;
    try {
      trace(request);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    lock.lock();
    busy_ = false;
    if (!error.empty()) error_ = error;
  }
}

}  // namespace welkin
