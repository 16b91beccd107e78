#include <welkin/image/compare.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include <welkin/image/srgb.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr std::size_t pixels_per_chunk = 1 << 14;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Sums {
  double weight = 0, squared_difference = 0, squared_reference = 0;
  double reference_max = -infinity;
  ImageDifference extreme;  // only max_* and unequal_faults

  void add(double a, double b, double w, std::size_t pixel, int channel) {
    const double difference = std::abs(a - b);
    weight += w;
    squared_difference += w * difference * difference;
    squared_reference += w * b * b;
    reference_max = std::max(reference_max, b);
    if (difference > extreme.max_abs) {
      extreme.max_abs = difference;
      extreme.max_pixel = pixel;
      extreme.max_channel = channel;
      extreme.max_a = a;
      extreme.max_b = b;
    }
  }
  void add(const Sums& later) {
    weight += later.weight;
    squared_difference += later.squared_difference;
    squared_reference += later.squared_reference;
    reference_max = std::max(reference_max, later.reference_max);
    const std::size_t faults = extreme.unequal_faults + later.extreme.unequal_faults;
    if (later.extreme.max_abs > extreme.max_abs) extreme = later.extreme;
    extreme.unequal_faults = faults;
  }
};

bool same_fault(float a, float b) { return (std::isnan(a) && std::isnan(b)) || a == b; }

ImageDifference finish(const Sums& sums) {
  ImageDifference result = sums.extreme;
  if (!(sums.weight > 0)) {
    result.psnr_db = infinity;
    return result;
  }
  const double reference_rms = std::sqrt(sums.squared_reference / sums.weight);
  result.rmse = std::sqrt(sums.squared_difference / sums.weight);
  if (result.rmse == 0) {
    result.psnr_db = infinity;
    return result;
  }
  result.relative_rmse = reference_rms > 0 ? result.rmse / reference_rms : infinity;
  result.psnr_db = sums.reference_max > 0 ? 20 * std::log10(sums.reference_max / result.rmse) : -infinity;
  return result;
}

}  // namespace

ImageDifference compare_images(std::span<const float> a, std::span<const float> b, int channels,
                               std::span<const float> weights) {
  assert(a.size() == b.size() && channels > 0 && a.size() % channels == 0);
  assert(weights.empty() || weights.size() == a.size() / channels);
  const auto partials = parallel_partials<Sums>(
      a.size() / channels, pixels_per_chunk, [&](Sums& sums, std::size_t begin, std::size_t end) {
        for (std::size_t pixel = begin; pixel < end; ++pixel) {
          const double weight = weights.empty() ? 1 : weights[pixel];
          for (int c = 0; c < channels; ++c) {
            const float va = a[pixel * channels + c], vb = b[pixel * channels + c];
            if (std::isfinite(va) && std::isfinite(vb)) {
              sums.add(va, vb, weight, pixel, c);
            } else {
              sums.extreme.unequal_faults += same_fault(va, vb) ? 0 : 1;
            }
          }
        }
      });
  Sums total;
  for (const Sums& part : partials) total.add(part);
  return finish(total);
}

namespace {

using Rgb = std::array<double, 3>;

double luminance_of(const Rgb& linear) {
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

// The linear luminance of CIE lightness 100 t.
double luminance_at(double t) {
  const double lightness = 100 * t;
  return lightness > 8 ? std::pow((lightness + 16) / 116, 3) : lightness / 903.3;
}

// The hue runs through linear-light key colours; then the colour is made darker, or mixed with white, until its
// luminance is that of lightness 100 t. So lightness is exact by construction whatever the keys are.
Rgb false_colour(double t) {
  constexpr std::array<Rgb, 6> keys{{{0.02, 0.05, 0.6},
                                     {0.1, 0.03, 0.8},
                                     {0.5, 0.02, 0.5},
                                     {0.9, 0.08, 0.05},
                                     {1, 0.4, 0.02},
                                     {1, 0.9, 0.1}}};
  const double position = t * (keys.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(position), keys.size() - 2);
  const double fraction = position - static_cast<double>(index);
  Rgb colour{};
  for (int c = 0; c < 3; ++c) colour[c] = (1 - fraction) * keys[index][c] + fraction * keys[index + 1][c];
  const double brightest = std::max({colour[0], colour[1], colour[2]});
  for (double& value : colour) value /= brightest;
  const double wanted = luminance_at(t), has = luminance_of(colour);
  const double white = wanted > has ? (wanted - has) / (1 - has) : 0;
  const double gain = wanted > has ? 1 - white : wanted / has;
  for (double& value : colour) value = std::min(1.0, gain * value + white);
  return colour;
}

using ColourTable = std::array<std::array<std::uint8_t, 3>, 256>;

ColourTable make_colours() {
  ColourTable table{};
  for (int i = 0; i < 256; ++i) {
    const Rgb colour = false_colour(i / 255.0);
    for (int c = 0; c < 3; ++c)
      table[i][c] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(colour[c])));
  }
  return table;
}

// The largest difference of a pixel's channels; NaN when the images have different faults there.
double pixel_difference(const float* a, const float* b, int channels) {
  double largest = 0;
  for (int c = 0; c < channels; ++c) {
    if (same_fault(a[c], b[c])) continue;
    if (!std::isfinite(a[c]) || !std::isfinite(b[c])) return std::numeric_limits<double>::quiet_NaN();
    largest = std::max(largest, std::abs(double{a[c]} - double{b[c]}));
  }
  return largest;
}

}  // namespace

ByteImage difference_image(const Image& a, const Image& b) {
  assert(a.width == b.width && a.height == b.height && a.channels == b.channels);
  static const ColourTable colours = make_colours();
  constexpr double lowest = 1e-6, decades = 8;
  Sums reference;
  for (float value : b.pixels) {
    if (std::isfinite(value)) reference.add(value, value, 1, 0, 0);
  }
  const double rms = reference.weight > 0 ? std::sqrt(reference.squared_reference / reference.weight) : 0;
  ByteImage result(a.width, a.height);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double difference = pixel_difference(a.at(x, y), b.at(x, y), a.channels);
      const double t =
          std::log10(difference / (rms > 0 ? rms : 1) / lowest) / decades;  // -infinity where equal
      const auto index = static_cast<std::size_t>(std::lround(255 * (t > 0 ? std::min(t, 1.0) : 0.0)));
      const std::array<std::uint8_t, 3> fault{0, 255, 0};
      const auto& colour = std::isnan(difference) ? fault : colours[index];
      std::copy(colour.begin(), colour.end(), result.at(x, y));
    }
  }
  return result;
}

}  // namespace welkin
