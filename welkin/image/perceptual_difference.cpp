#include <welkin/image/perceptual_difference.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/parallel/parallel_for.h>

// Section and equation numbers below are those of Andersson et al. 2020.

namespace welkin {
namespace {

using Colour = std::array<double, 3>;
constexpr Colour white{0.950428545, 1, 1.088900371};  // XYZ of (1, 1, 1): D65

Colour to_xyz(const Colour& c) {  // Rec. 709 primaries
  return {0.412390799 * c[0] + 0.357584339 * c[1] + 0.180480788 * c[2],
          0.212639006 * c[0] + 0.715168679 * c[1] + 0.072192315 * c[2],
          0.019330819 * c[0] + 0.119194780 * c[1] + 0.950532152 * c[2]};
}
Colour to_rgb(const Colour& c) {
  return {3.240969942 * c[0] - 1.537383178 * c[1] - 0.498610760 * c[2],
          -0.969243636 * c[0] + 1.875967502 * c[1] + 0.041555057 * c[2],
          0.055630080 * c[0] - 0.203976959 * c[1] + 1.056971514 * c[2]};
}

// Section 4.1.1: opponent colours that are linear in light, achromatic, red-green, blue-yellow.
Colour to_opponent(const Colour& rgb) {
  const Colour xyz = to_xyz(rgb);
  const double x = xyz[0] / white[0], y = xyz[1], z = xyz[2] / white[2];
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}
Colour from_opponent(const Colour& c) {
  const double y = (c[0] + 16) / 116;
  return to_rgb({white[0] * (y + c[1] / 500), y, white[2] * (y - c[2] / 200)});
}

// CIE L*a*b*, then the colours of dark pixels count less (Hunt 1952; section 4.1.2).
Colour to_hunt_lab(const Colour& rgb) {
  const Colour xyz = to_xyz(rgb);
  const auto f = [](double t) {
    constexpr double d = 6.0 / 29;
    return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
  };
  const double x = f(xyz[0] / white[0]), y = f(xyz[1]), z = f(xyz[2] / white[2]);
  const double lightness = 116 * y - 16;
  return {lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)};
}

// HyAB (Abasi et al. 2020): for differences that are large.
double hyab(const Colour& a, const Colour& b) {
  return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// A picture as planes of doubles.
struct Plane {
  int width = 0, height = 0;
  std::vector<double> values;
};

// Odd kernels, applied along x and then along y; beyond the edges the edge goes on.
using Kernel = std::vector<double>;

template <bool along_x>
Plane filtered(const Plane& source, const Kernel& kernel) {
  const int radius = static_cast<int>(kernel.size()) / 2, width = source.width, height = source.height;
  Plane result{width, height, std::vector<double>(source.values.size())};
  parallel_for(static_cast<std::size_t>(height), 8, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0;
        for (int d = -radius; d <= radius; ++d) {
          const int sx = along_x ? std::clamp(x + d, 0, width - 1) : x;
          const int sy = along_x ? y : std::clamp(y + d, 0, height - 1);
          sum += kernel[static_cast<std::size_t>(d + radius)] *
                 source.values[static_cast<std::size_t>(sy) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(sx)];
        }
        result.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)] = sum;
      }
  });
  return result;
}

Plane separable(const Plane& source, const Kernel& x, const Kernel& y) {
  return filtered<false>(filtered<true>(source, x), y);
}

template <class Function>
Kernel make_kernel(int radius, const Function& function) {
  Kernel kernel;
  for (int d = -radius; d <= radius; ++d) kernel.push_back(function(double(d)));
  return kernel;
}

// Contrast sensitivity as Gaussians (section 4.1.1, table 1): a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees. In two
// dimensions its integral over the plane is a times the same factor squared over..., so that only ratios matter: the sum
// of all weights is made 1.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity sensitivities[3] = {
    {1, 0.0047, 0, 1e-5}, {1, 0.0053, 0, 1e-5}, {34.1, 0.04, 13.5, 0.025}};

Plane seen(const Plane& source, const Sensitivity& s, double pixels_per_degree) {
  // Three standard deviations of the widest Gaussian: exp(-pi^2 x^2 / b) has the variance b / (2 pi^2).
  const int radius = static_cast<int>(
      std::ceil(3 * std::sqrt(0.04 / (2 * std::numbers::pi * std::numbers::pi)) * pixels_per_degree));
  Plane result;
  double total = 0;
  for (const auto& [a, b] : {std::pair{s.a1, s.b1}, std::pair{s.a2, s.b2}}) {
    if (a == 0) continue;
    const double rate = std::numbers::pi * std::numbers::pi / (b * pixels_per_degree * pixels_per_degree);
    const Kernel kernel = make_kernel(radius, [rate](double d) { return std::exp(-rate * d * d); });
    double sum = 0;
    for (const double value : kernel) sum += value;
    const double weight = a * std::sqrt(std::numbers::pi / b);
    total += weight * sum * sum;
    const Plane part = separable(source, kernel, kernel);
    if (result.values.empty())
      result = {source.width, source.height, std::vector<double>(source.values.size())};
    for (std::size_t i = 0; i < part.values.size(); ++i) result.values[i] += weight * part.values[i];
  }
  for (double& value : result.values) value /= total;
  return result;
}

using Planes = std::array<Plane, 3>;

Planes opponent_planes(const Image& image) {
  Planes planes;
  for (Plane& plane : planes)
    plane = {image.width, image.height, std::vector<double>(image.pixels.size() / 3)};
  for (std::size_t i = 0; i < image.pixels.size() / 3; ++i) {
    Colour rgb;
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = image.pixels[3 * i + c];
      rgb[c] = value > 0 ? std::min(value, 1.0) : 0;
    }
    const Colour opponent = to_opponent(rgb);
    for (std::size_t c = 0; c < 3; ++c) planes[c].values[i] = opponent[c];
  }
  return planes;
}

std::vector<Colour> perceived_colours(const Planes& planes, double pixels_per_degree) {
  Planes smooth;
  for (std::size_t c = 0; c < 3; ++c) smooth[c] = seen(planes[c], sensitivities[c], pixels_per_degree);
  std::vector<Colour> colours(planes[0].values.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    Colour rgb = from_opponent({smooth[0].values[i], smooth[1].values[i], smooth[2].values[i]});
    for (double& value : rgb) value = std::clamp(value, 0.0, 1.0);
    colours[i] = to_hunt_lab(rgb);
  }
  return colours;
}

// Section 4.1.3: the power 0.7, then two straight lines that give the smaller 40 % of all distances 95 % of the range.
double colour_error(const Colour& a, const Colour& b) {
  static const double most = std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), 0.7);
  constexpr double knee = 0.4, at_knee = 0.95;
  const double error = std::pow(hyab(a, b), 0.7) / most;
  if (error < knee) return error * at_knee / knee;
  return std::min(1.0, at_knee + (error - knee) / (1 - knee) * (1 - at_knee));
}

// Section 4.2: Gaussian derivatives of a width that the eye resolves, scaled so that each kernel's positive and negative
// weights sum to 1 and -1.
struct FeatureKernels {
  Kernel smooth, edge, point;
};

Kernel with_unit_sides(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const double value : kernel) (value > 0 ? positive : negative) += std::abs(value);
  for (double& value : kernel) value /= value > 0 ? positive : negative;
  return kernel;
}

FeatureKernels feature_kernels(double pixels_per_degree) {
  constexpr double width_degrees = 0.082;
  const double sigma = 0.5 * width_degrees * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto gauss = [sigma](double d) { return std::exp(-d * d / (2 * sigma * sigma)); };
  Kernel smooth = make_kernel(radius, gauss);
  double sum = 0;
  for (const double value : smooth) sum += value;
  for (double& value : smooth) value /= sum;
  return {smooth, with_unit_sides(make_kernel(radius, [&](double d) { return -d * gauss(d); })),
          with_unit_sides(
              make_kernel(radius, [&](double d) { return (d * d / (sigma * sigma) - 1) * gauss(d); }))};
}

// Lengths of the vectors of derivatives along x and y.
Plane feature_strength(const Plane& lightness, const Kernel& smooth, const Kernel& derivative) {
  Plane result = separable(lightness, derivative, smooth);
  const Plane down = separable(lightness, smooth, derivative);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = std::hypot(result.values[i], down.values[i]);
  return result;
}

std::vector<double> feature_errors(Plane a, Plane b, double pixels_per_degree) {
  const FeatureKernels kernels = feature_kernels(pixels_per_degree);
  for (Plane* plane : {&a, &b})
    for (double& value : plane->values) value = (value + 16) / 116;
  std::vector<double> largest(a.values.size());
  for (const Kernel& derivative : {kernels.edge, kernels.point}) {
    const Plane of_a = feature_strength(a, kernels.smooth, derivative);
    const Plane of_b = feature_strength(b, kernels.smooth, derivative);
    for (std::size_t i = 0; i < largest.size(); ++i)
      largest[i] = std::max(largest[i], std::abs(of_a.values[i] - of_b.values[i]));
  }
  for (double& value : largest) value = std::sqrt(std::min(1.0, value / std::numbers::sqrt2));
  return largest;
}

void summarise(PerceptualDifference& result) {
  std::vector<float> values = result.map.pixels;
  double sum = 0;
  for (const float value : values) sum += double{value};
  result.mean = sum / static_cast<double>(values.size());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  result.median = double{*middle};
  result.largest = double{*std::max_element(values.begin(), values.end())};
}

}  // namespace

PerceptualDifference perceptual_difference(const Image& a, const Image& b, const PerceptualOptions& options) {
  assert(a.channels == 3 && b.channels == 3 && a.width == b.width && a.height == b.height);
  assert(options.pixels_per_degree > 0);
  const Planes of_a = opponent_planes(a), of_b = opponent_planes(b);
  const auto colours_a = perceived_colours(of_a, options.pixels_per_degree);
  const auto colours_b = perceived_colours(of_b, options.pixels_per_degree);
  const auto features = feature_errors(of_a[0], of_b[0], options.pixels_per_degree);
  PerceptualDifference result;
  result.map = Image(a.width, a.height, 1);
  // Section 4.3: a difference of features raises that of colours.
  for (std::size_t i = 0; i < features.size(); ++i)
    result.map.pixels[i] =
        static_cast<float>(std::pow(colour_error(colours_a[i], colours_b[i]), 1 - features[i]));
  summarise(result);
  return result;
}

ByteImage perceptual_map_image(const Image& map) {
  constexpr double stops[][3] = {{0, 0, 4},     {40, 11, 84},   {101, 21, 110}, {159, 42, 99},
                                 {212, 72, 66}, {245, 125, 21}, {250, 193, 39}, {252, 255, 164}};
  constexpr int last = 7;
  ByteImage image(map.width, map.height, 3);
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    const double at = std::clamp<double>(map.pixels[i], 0, 1) * last;
    const int low = std::min(static_cast<int>(at), last - 1);
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[3 * i + c] = static_cast<std::uint8_t>(
          std::lround(stops[low][c] + (at - low) * (stops[low + 1][c] - stops[low][c])));
  }
  return image;
}

}  // namespace welkin
