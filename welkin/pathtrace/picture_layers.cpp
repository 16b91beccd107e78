#include <algorithm>
#include <array>
#include <cmath>

#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/picture.h>

namespace welkin {
namespace {

constexpr std::size_t pixels_per_chunk = 1 << 12;

// How many of `count` samples the replicate got: they are dealt in turn.
double samples_of(std::uint32_t count, int replicate) {
  const auto r = static_cast<std::uint32_t>(replicate);
  return count / picture_replicates + (r < count % picture_replicates ? 1 : 0);
}

// The variance of the mean of all n samples of a pixel, of the values that `value_of` finds in a replicate's sums.
// With n_r of them in replicate r, whose mean m_r has the variance v / n_r of a common v, sum n_r (m_r - m)^2 has the
// expectation (R - 1) v, and the mean over all samples the variance v / n.
template <class ValueOf>
double variance_of_mean(const PictureState& state, std::size_t pixel, const ValueOf& value_of) {
  const std::uint32_t count = state.count[pixel];
  std::array<double, picture_replicates> means{}, weights{};
  double mean = 0;
  for (int r = 0; r < picture_replicates; ++r) {
    const double samples = samples_of(count, r);
    if (samples == 0) continue;
    weights[r] = samples / count;
    means[r] =
        value_of(&state.replicate_sum[3 * (pixel * picture_replicates + static_cast<std::size_t>(r))]) /
        samples;
    mean += weights[r] * means[r];
  }
  double spread = 0;
  for (int r = 0; r < picture_replicates; ++r) spread += weights[r] * (means[r] - mean) * (means[r] - mean);
  const double replicates = std::min<double>(count, picture_replicates);
  return replicates > 1 ? spread / (replicates - 1) : 0;
}

float ratio(double sum, double count) { return count > 0 ? static_cast<float>(sum / count) : 0.0f; }

void fill_pixel(const PictureState& state, std::size_t pixel, PictureLayers& layers) {
  const double count = state.count[pixel];
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t i = 3 * pixel + c;
    layers.radiance.pixels[i] = ratio(state.radiance_sum[i], count);
    layers.albedo.pixels[i] = ratio(state.albedo_sum[i], count);
    layers.normal.pixels[i] = ratio(state.normal_sum[i], count);
    layers.standard_error.pixels[i] = static_cast<float>(
        std::sqrt(variance_of_mean(state, pixel, [c](const float* sums) { return double{sums[c]}; })));
  }
  layers.depth.pixels[pixel] = ratio(state.depth_sum[pixel], state.coverage_sum[pixel]);
  layers.coverage.pixels[pixel] = ratio(state.coverage_sum[pixel], count);
  layers.samples.pixels[pixel] = static_cast<float>(count);
}

}  // namespace

double luminance_variance(const PictureState& state, std::size_t pixel) {
  return variance_of_mean(state, pixel, [](const float* sums) {
    return 0.2126 * double{sums[0]} + 0.7152 * double{sums[1]} + 0.0722 * double{sums[2]};
  });
}

Image picture_radiance(const PictureState& state) {
  Image image(state.size.width, state.size.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = ratio(state.radiance_sum[i], state.count[i / 3]);
  return image;
}

PictureLayers make_picture_layers(const PictureState& state) {
  const auto image = [&](int channels) { return Image(state.size.width, state.size.height, channels); };
  PictureLayers layers{image(3), image(3), image(3), image(3), image(1), image(1), image(1)};
  parallel_for(state.count.size(), pixels_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) fill_pixel(state, pixel, layers);
  });
  return layers;
}

}  // namespace welkin
