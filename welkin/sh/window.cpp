#include <welkin/sh/window.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/minimum.h>
#include <welkin/sh/minimum_search.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

void check_width(double width, int max_degree) {
  if (!(width > 0)) throw Error("the width of a window must be positive");
  if (max_degree < 0 || max_degree > max_basis_degree)
    throw Error("the degree must be between 0 and " + std::to_string(max_basis_degree));
}

ShCoefficients channel_of(const ShCoefficients& all, int channel) {
  ShCoefficients one(all.max_degree, 1);
  for (std::size_t i = 0; i < one.values.size(); ++i) one.values[i] = all.values[i * all.channels + channel];
  return one;
}

ShCoefficients luminance_of(const ShCoefficients& rgb) {
  ShCoefficients one(rgb.max_degree, 1);
  for (std::size_t i = 0; i < one.values.size(); ++i)
    one.values[i] =
        0.2126 * rgb.values[3 * i] + 0.7152 * rgb.values[3 * i + 1] + 0.0722 * rgb.values[3 * i + 2];
  return one;
}

SphereMinimum minimum_of(const ShCoefficients& f) {
  if (f.max_degree > 2) return find_minimum(f);
  const ShCoefficients nine = resize(f, 2);
  SphereMinimum minimum;
  minimum.value = minimum_degree2(std::span<const double, 9>(nine.values.data(), 9), &minimum.where);
  return minimum;
}

// What each degree contributes in a direction.
std::vector<double> degree_values(const ShCoefficients& f, Vec3 direction) {
  std::vector<double> y(sh_count(f.max_degree)), values(f.max_degree + 1);
  evaluate_sh_basis(direction, f.max_degree, y);
  for (int l = 0; l <= f.max_degree; ++l)
    for (int m = -l; m <= l; ++m) values[l] += f.values[sh_index(l, m)] * y[sh_index(l, m)];
  return values;
}

double windowed_value(std::span<const double> degree_values, double lambda) {
  double sum = 0;
  for (std::size_t l = 0; l < degree_values.size(); ++l) {
    const double laplacian = static_cast<double>(l * (l + 1));
    sum += degree_values[l] / (1 + lambda * laplacian * laplacian);
  }
  return sum;
}

// The first lambda beyond `from` at which the value in one direction is not negative, found by steps of 5 % and
// bisection; the upper end of the last interval, so that it is not negative there. Infinity if there is none.
double first_lit(std::span<const double> values, double from) {
  double low = from, high = std::max(1.05 * from, 1e-9);
  while (windowed_value(values, high) < 0) {
    low = high;
    high *= 1.05;
    if (high > 1e15) return infinity;
  }
  for (int i = 0; i < 60 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    (windowed_value(values, middle) < 0 ? low : high) = middle;
  }
  return high;
}

// Every step goes to a lambda below which some direction of some function is negative, so never past the smallest.
double weakest_for(std::span<const ShCoefficients> functions) {
  double lambda = 0;
  for (int step = 0; step < 100 && lambda < infinity; ++step) {
    double next = lambda;
    for (const ShCoefficients& f : functions) {
      const SphereMinimum minimum = minimum_of(convolve(f, laplacian_window(lambda, f.max_degree)));
      const double mean = f.values[0] / std::sqrt(4 * pi);
      if (minimum.value < -1e-12 * mean)
        next = std::max(next, first_lit(degree_values(f, minimum.where), lambda));
    }
    if (next == lambda) break;
    lambda = next;
  }
  return lambda;
}

void check_window_input(const ShCoefficients& coefficients, WindowScope scope) {
  check_coefficients(coefficients);
  if (coefficients.max_degree > max_minimum_search_degree)
    throw Error("the weakest window is found up to degree " + std::to_string(max_minimum_search_degree) +
                ", not " + std::to_string(coefficients.max_degree));
  if (scope == WindowScope::luminance && coefficients.channels != 3)
    throw Error("luminance needs 3 channels, not " + std::to_string(coefficients.channels));
  for (double value : coefficients.values)
    if (!std::isfinite(value)) throw Error("the coefficients are not all finite");
  for (int c = 0; c < coefficients.channels; ++c)
    if (coefficients.values[c] < 0)
      throw Error("the mean of channel " + std::to_string(c) +
                  " is negative: no window makes the function non-negative");
}

}  // namespace

std::vector<double> hann_window(double width, int max_degree) {
  check_width(width, max_degree);
  std::vector<double> factors(max_degree + 1);
  for (int l = 0; l <= max_degree && l < width; ++l) factors[l] = (1 + std::cos(pi * l / width)) / 2;
  return factors;
}

std::vector<double> lanczos_window(double width, int max_degree) {
  check_width(width, max_degree);
  std::vector<double> factors(max_degree + 1);
  factors[0] = 1;
  for (int l = 1; l <= max_degree && l < width; ++l) {
    const double x = pi * l / width;
    factors[l] = std::sin(x) / x;
  }
  return factors;
}

std::vector<double> laplacian_window(double lambda, int max_degree) {
  if (!(lambda >= 0)) throw Error("the lambda of a window must not be negative");
  check_width(1, max_degree);
  std::vector<double> factors(max_degree + 1);
  factors[0] = 1;
  for (int l = 1; l <= max_degree; ++l) {
    const double laplacian = l * (l + 1.0);
    factors[l] = 1 / (1 + lambda * laplacian * laplacian);
  }
  return factors;
}

std::vector<double> weakest_laplacian(const ShCoefficients& coefficients, WindowScope scope) {
  check_window_input(coefficients, scope);
  std::vector<ShCoefficients> functions;
  if (scope == WindowScope::luminance)
    functions.push_back(luminance_of(coefficients));
  else
    for (int c = 0; c < coefficients.channels; ++c) functions.push_back(channel_of(coefficients, c));
  if (scope != WindowScope::each_channel)
    return std::vector<double>(coefficients.channels, weakest_for(functions));
  std::vector<double> lambdas;
  for (const ShCoefficients& f : functions) lambdas.push_back(weakest_for(std::span(&f, 1)));
  return lambdas;
}

ShCoefficients laplacian_windowed(const ShCoefficients& coefficients, std::span<const double> lambdas) {
  check_coefficients(coefficients);
  if (static_cast<int>(lambdas.size()) != coefficients.channels)
    throw Error("coefficients with " + std::to_string(coefficients.channels) +
                " channels need as many windows, not " + std::to_string(lambdas.size()));
  ShCoefficients result = coefficients;
  for (int c = 0; c < result.channels; ++c) {
    const std::vector<double> factors = laplacian_window(lambdas[c], result.max_degree);
    for (int l = 0; l <= result.max_degree; ++l)
      for (int m = -l; m <= l; ++m) result.values[sh_index(l, m) * result.channels + c] *= factors[l];
  }
  return result;
}

}  // namespace welkin
