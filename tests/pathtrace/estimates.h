#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <welkin/pathtrace/integrator.h>

// Means of many samples with their standard errors, and scenes for them.

namespace welkin::oracle {

struct Estimate {
  double mean = 0, standard_error = 0;
};

/// Sums numbers to a mean.
struct Tally {
  double sum = 0, squares = 0;
  long count = 0;

  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  Estimate estimate() const {
    const double mean = sum / static_cast<double>(count);
    const double variance = std::max(0.0, squares / static_cast<double>(count) - mean * mean);
    return {mean, std::sqrt(variance / static_cast<double>(count - 1))};
  }
};

/// Luminance of one pixel's samples [0, samples), their mean.
inline double pixel_luminance(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                              std::uint32_t samples, const IntegratorOptions& options) {
  std::vector<SampleNumber> numbers(samples);
  for (std::uint32_t i = 0; i < samples; ++i) numbers[i] = {i, options.seed};
  std::vector<PixelSample> values(samples);
  render_samples(scene, camera, size, x, y, numbers, options, values);
  double sum = 0;
  for (const PixelSample& value : values) sum += luminance(value.radiance);
  return sum / samples;
}

/// Mean luminance over all pixels. The standard error comes from the scatter of the pixels' means, which are independent of
/// each other, while the samples of one pixel are stratified against each other; it counts what differs between the
/// pixels' true values as noise, so it is too large where they do.
inline Estimate picture_luminance(const RenderScene& scene, const Camera& camera, PictureSize size,
                                  std::uint32_t samples, const IntegratorOptions& options) {
  Tally tally;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      tally.add(pixel_luminance(scene, camera, size, x, y, samples, options));
    }
  }
  return tally.estimate();
}

/// An environment of one radiance from everywhere.
inline EnvironmentSampler constant_environment(Rgb radiance) {
  Image map(8, 4);
  for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
    map.pixels[i] = radiance.r;
    map.pixels[i + 1] = radiance.g;
    map.pixels[i + 2] = radiance.b;
  }
  return EnvironmentSampler(std::move(map));
}

}  // namespace welkin::oracle
