#include <welkin/image/range_fit.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr std::size_t values_per_chunk = 1 << 17;

// How many values are not inside [-limit, limit], or [0, limit] without a sign. NaN is inside nothing.
std::size_t count_outside(std::span<const float> values, PixelFormat format, double stored_scale) {
  const double limit = pixel_format_max(format) * stored_scale;
  const double lowest = pixel_format_has_sign(format) ? -limit : 0.0;
  const auto counts = parallel_partials<std::size_t>(
      values.size(), values_per_chunk, [&](std::size_t& count, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) count += values[i] >= lowest && values[i] <= limit ? 0 : 1;
      });
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

}  // namespace

float largest_storable(std::span<const float> values, PixelFormat format) {
  const bool has_sign = pixel_format_has_sign(format);
  const auto maxima = parallel_partials<float>(
      values.size(), values_per_chunk, [&](float& largest, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const float magnitude = has_sign ? std::abs(values[i]) : values[i];
          const bool counts = magnitude <= std::numeric_limits<float>::max();  // not for infinity and NaN
          largest = std::max(largest, counts ? magnitude : 0.0f);
        }
      });
  return maxima.empty() ? 0.0f : *std::max_element(maxima.begin(), maxima.end());
}

double scale_for(float largest, PixelFormat format, RangePolicy policy) {
  double scale = 1;
  if (policy == RangePolicy::clip) return scale;
  const double limit = pixel_format_max(format);
  while (largest > limit * scale) scale *= 2;
  // Dim data would fall among the coarse small numbers of a 16-bit format.
  const bool dim = format != PixelFormat::rgba32f && format != PixelFormat::rg32f && largest < 1.0 / 64;
  while (dim && largest > 0 && largest < 0.5 * scale) scale /= 2;
  return scale;
}

RangeFit choose_scale(std::span<const float> values, PixelFormat format, RangePolicy policy) {
  const double scale = scale_for(largest_storable(values, format), format, policy);
  return {scale, count_outside(values, format, scale)};
}

RangeFit choose_scale(const CubeMips& cube, PixelFormat format, RangePolicy policy) {
  float largest = 0;
  for (const Cube& level : cube.levels) largest = std::max(largest, largest_storable(level.texels, format));
  RangeFit fit{scale_for(largest, format, policy), 0};
  for (const Cube& level : cube.levels) fit.clipped += count_outside(level.texels, format, fit.stored_scale);
  return fit;
}

}  // namespace welkin
