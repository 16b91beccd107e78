#include <algorithm>
#include <cmath>
#include <vector>

#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/picture_loop.h>

// When a pixel has samples enough. The error of one pixel is known with seven degrees of freedom only, and a pixel that
// has not met the one bright thing in its sight looks quiet: both are why the mean of the variance over 5 x 5 pixels
// decides, together with the pixel's own, which may be no more than twice as large. A pixel whose neighbours have seen
// something goes on with them. What is left of the bias of stopping by one's own samples is measured in
// docs/rendering.md.

namespace welkin {
namespace {

constexpr int window_radius = 2;
constexpr double own_slack = 2;  // the pixel's own error against the target

// Means over windows of (2 radius + 1)^2 pixels, cut off at the picture's edges; separable.
std::vector<double> window_means(const std::vector<double>& values, PictureSize size) {
  const auto pass = [&](const std::vector<double>& from, std::size_t step, int along, int length) {
    std::vector<double> to(from.size());
    parallel_for(from.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int at = along == 0 ? static_cast<int>(i % static_cast<std::size_t>(size.width))
                                  : static_cast<int>(i / static_cast<std::size_t>(size.width));
        const int low = std::max(-window_radius, -at), high = std::min(window_radius, length - 1 - at);
        double sum = 0;
        for (int d = low; d <= high; ++d)
          sum += from[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) +
                                               d * static_cast<std::ptrdiff_t>(step))];
        to[i] = sum / (high - low + 1);
      }
    });
    return to;
  };
  return pass(pass(values, 1, 0, size.width), static_cast<std::size_t>(size.width), 1, size.height);
}

struct ErrorMap {
  std::vector<double> own, windowed, reference;  // variances of luminance; luminance
};

// exp of the mean logarithm over windows that are not black; 0 for a black picture.
double log_average(const std::vector<double>& luminances) {
  double sum = 0, count = 0;
  for (const double l : luminances) {
    if (!(l > 0)) continue;
    sum += std::log(l);
    ++count;
  }
  return count > 0 ? std::exp(sum / count) : 0;
}

ErrorMap map_errors(const PictureState& state) {
  const std::size_t pixels = state.count.size();
  std::vector<double> luminances(pixels);
  ErrorMap map;
  map.own.resize(pixels);
  parallel_for(pixels, 1 << 12, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const double* sum = &state.radiance_sum[3 * i];
      luminances[i] = (0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2]) / std::max(1u, state.count[i]);
      map.own[i] = luminance_variance(state, i);
    }
  });
  map.windowed = window_means(map.own, state.size);
  map.reference = window_means(luminances, state.size);
  const double average = log_average(map.reference);
  for (double& reference : map.reference) reference = std::max(reference, average);
  return map;
}

// The error brings the number of samples it wants, n (error / target)^2, but no more than twice what there is: the
// error may be a chance. Whole batches, so that these are the same wherever a run is stopped.
std::uint32_t next_goal(std::uint32_t count, double excess, std::uint32_t most) {
  constexpr std::uint32_t batch = picture_loop::batch_size;
  const double wanted = count * std::clamp(excess, 1.0, 2.0);
  const auto batches = static_cast<std::uint32_t>(std::ceil(wanted / batch));
  return std::min(most, std::max(count / batch + 1, batches) * batch);
}

bool plan_adaptive(PictureState& state, const PictureOptions& options) {
  const ErrorMap map = map_errors(state);
  bool any = false;
  for (std::size_t i = 0; i < state.count.size(); ++i) {
    const double allowed = std::pow(options.target_error * map.reference[i], 2);
    const double error = std::max(map.windowed[i], map.own[i] / (own_slack * own_slack));
    if (!(error > allowed) || state.count[i] >= options.samples) continue;
    state.goal[i] = next_goal(state.count[i], error / allowed, options.samples);
    any = true;
  }
  return any;
}

// All pixels alike: rounds of whole batches that double, up to 64 samples, so that there is soon something to see.
bool plan_uniform(PictureState& state, std::uint32_t samples) {
  constexpr std::uint32_t longest = 64;
  const std::uint32_t least = *std::min_element(state.count.begin(), state.count.end());
  if (least >= samples) return false;
  constexpr std::uint32_t batch = picture_loop::batch_size;
  const std::uint32_t whole = (least + std::clamp(least, batch, longest)) / batch * batch;
  const std::uint32_t goal = std::min(samples, whole);
  for (std::size_t i = 0; i < state.count.size(); ++i) state.goal[i] = std::max(state.count[i], goal);
  return true;
}

}  // namespace

bool plan_round(PictureState& state, const PictureOptions& options) {
  if (options.target_error <= 0) return plan_uniform(state, options.samples);
  if (plan_uniform(state, std::min(options.samples, options.least_samples))) return true;
  return plan_adaptive(state, options);
}

PictureError picture_error(const PictureState& state, double target_error) {
  const ErrorMap map = map_errors(state);
  const auto pixels = static_cast<double>(state.count.size());
  PictureError result;
  double squares = 0, relative = 0, reached = 0;
  for (std::size_t i = 0; i < state.count.size(); ++i) {
    const double reference = map.reference[i] * map.reference[i];
    result.mean_samples += state.count[i];
    squares += map.own[i];
    if (reference > 0) relative += map.own[i] / reference;
    const double windowed = reference > 0 ? std::sqrt(map.windowed[i] / reference) : 0;
    result.worst_relative_error = std::max(result.worst_relative_error, windowed);
    reached += windowed <= target_error ? 1 : 0;
  }
  result.mean_samples /= pixels;
  result.mean_standard_error = std::sqrt(squares / pixels);
  result.mean_relative_error = std::sqrt(relative / pixels);
  result.share_reached = reached / pixels;
  return result;
}

}  // namespace welkin
