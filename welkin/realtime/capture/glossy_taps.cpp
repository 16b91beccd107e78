#include <welkin/realtime/capture/glossy_taps.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/envmap/methods/quick_taps.h>
#include <welkin/envmap/methods/working_cube.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

ZonalKernel kernel_of(double perceptual_roughness) {
  return make_ggx_kernel(std::max(perceptual_roughness * perceptual_roughness, 1e-4));
}

// Base 2, its digits behind the point the other way round.
double radical_inverse(int index) {
  double value = 0, digit = 0.5;
  for (; index > 0; index /= 2, digit /= 2) value += digit * (index % 2);
  return value;
}

Vec3f to_vec3f(Vec3 d) { return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)}; }

}  // namespace

GlossyTaps make_quick_taps(double perceptual_roughness, int count, int size) {
  const double least_deviation = 0.5 * std::sqrt(4 * pi / 6) / size;
  GlossyTaps taps;
  for (const QuickTap& tap : fit_quick_taps(kernel_of(perceptual_roughness), count, least_deviation).taps) {
    taps.directions.push_back(to_vec3f(tap.direction));
    taps.sizes.push_back({static_cast<float>(tap.deviation), static_cast<float>(tap.weight), 0});
  }
  return taps;
}

// As filter_importance: level = 1/2 log2(omega_s / omega_t) + 1, omega_s = 1 / (samples pdf).
GlossyTaps make_importance_taps(double perceptual_roughness, int count, int size) {
  const ZonalKernel kernel = kernel_of(perceptual_roughness);
  const KernelQuantiles quantiles(kernel);
  const double texel = 4 * pi / (6.0 * size * size);
  GlossyTaps taps;
  for (int i = 0; i < count; ++i) {
    const double u = quantiles.one_minus_cos((i + 0.5) / count), phi = 2 * pi * radical_inverse(i);
    const double across = std::sqrt(std::max(0.0, u * (2 - u)));
    taps.directions.push_back(to_vec3f({across * std::cos(phi), across * std::sin(phi), 1 - u}));
    const double level = 0.5 * std::log2(1 / (count * evaluate(kernel, u) * texel)) + 1;
    taps.sizes.push_back({static_cast<float>(std::max(0.0, level)), 1.0f / static_cast<float>(count), 0});
  }
  return taps;
}

std::vector<float> glossy_spreads() {
  std::vector<float> spreads(17);
  for (int i = 1; i <= 16; ++i)
    spreads[static_cast<std::size_t>(i)] = static_cast<float>(kernel_spread(kernel_of(i / 16.0)));
  return spreads;
}

double roughness_of_spread(double spread_radians) {
  double low = 0.01, high = 1;
  for (int step = 0; step < 24; ++step) {
    const double middle = 0.5 * (low + high);
    (kernel_spread(kernel_of(middle)) < spread_radians ? low : high) = middle;
  }
  return high;
}

}  // namespace welkin
