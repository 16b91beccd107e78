#include <welkin/realtime/viewer/false_color.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace welkin {

const ColorScale& signed_colors() {
  static constexpr ColorScale colors = {{{0.75f, 0.95f, 1.00f},
                                         {0.20f, 0.60f, 1.00f},
                                         {0.05f, 0.20f, 0.55f},
                                         {0.00f, 0.00f, 0.00f},
                                         {0.55f, 0.12f, 0.02f},
                                         {1.00f, 0.50f, 0.10f},
                                         {1.00f, 0.95f, 0.70f}}};
  return colors;
}

const ColorScale& size_colors() {
  static constexpr ColorScale colors = {{{0.00f, 0.00f, 0.00f},
                                         {0.10f, 0.10f, 0.45f},
                                         {0.48f, 0.08f, 0.52f},
                                         {0.82f, 0.20f, 0.25f},
                                         {0.95f, 0.52f, 0.10f},
                                         {0.98f, 0.85f, 0.30f},
                                         {1.00f, 1.00f, 1.00f}}};
  return colors;
}

Rgb false_color(const ColorScale& colors, float position) {
  const float at = std::clamp(position, 0.0f, 1.0f) * (color_stops - 1);
  const int below = std::min(static_cast<int>(at), color_stops - 2);
  const float share = at - static_cast<float>(below);
  return (1 - share) * colors[static_cast<std::size_t>(below)] +
         share * colors[static_cast<std::size_t>(below) + 1];
}

double nice_scale(double value) {
  if (!(value > 1e-6)) return 1e-6;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0, 10.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

std::vector<LegendMark> legend_marks(double scale, bool with_sign) {
  std::vector<LegendMark> marks;
  for (int i = 0; i < 5; ++i) {
    const double share = i / 4.0;
    marks.push_back({static_cast<float>(share), with_sign ? scale * (2 * share - 1) : scale * share});
  }
  return marks;
}

namespace {

struct PixelDifference {
  bool counts = false, finite = true;
  double sum = 0, squares = 0, reference_squares = 0, largest = 0;
};

PixelDifference compare_pixel(const float* a, int a_channels, const float* b, int b_channels) {
  PixelDifference d;
  d.counts = (a_channels < 4 || a[3] >= 1) && (b_channels < 4 || b[3] >= 1);
  for (int c = 0; c < 3; ++c) {
    const double difference = double{a[c]} - b[c];
    d.finite = d.finite && std::isfinite(a[c]) && std::isfinite(b[c]);
    d.sum += difference;
    d.squares += difference * difference;
    d.reference_squares += double{b[c]} * b[c];
    d.largest = std::max(d.largest, std::abs(difference));
  }
  return d;
}

// The value that 99 of 100 do not exceed; sorts in part.
double percentile_99(std::vector<float>& sizes) {
  const std::size_t index = (sizes.size() * 99 + 99) / 100 - 1;
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(index), sizes.end());
  return sizes[index];
}

}  // namespace

DifferenceNumbers measure_difference(const Image& picture, const Image& reference) {
  assert(picture.width == reference.width && picture.height == reference.height);
  DifferenceNumbers n;
  std::vector<float> sizes;
  double sum = 0, squares = 0, reference_squares = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const PixelDifference d =
          compare_pixel(picture.at(x, y), picture.channels, reference.at(x, y), reference.channels);
      if (!d.counts) continue;
      if (!d.finite) {
        ++n.faults;
        continue;
      }
      sum += d.sum;
      squares += d.squares;
      reference_squares += d.reference_squares;
      sizes.push_back(static_cast<float>(d.largest));
      n.largest = std::max(n.largest, d.largest);
    }
  }
  n.pixels = sizes.size();
  if (sizes.empty()) return n;
  const double values = 3 * static_cast<double>(n.pixels);
  n.mean = sum / values;
  n.rms = std::sqrt(squares / values);
  n.relative_rms = reference_squares > 0 ? std::sqrt(squares / reference_squares) : 0;
  n.p99 = percentile_99(sizes);
  return n;
}

}  // namespace welkin
