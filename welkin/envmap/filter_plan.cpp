#include <welkin/envmap/filter_plan.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int max_degree = 2048;   // beyond it a core is always cheaper
constexpr double axis_safety = 2;  // costs little: spectra of smooth kernels fall exponentially
constexpr double smallest_factor = 3e-5;

// Error bound. Dropping degrees > L leaves out the convolution with K - K_L, a ripple of wavelength 2 pi/L. It is
// largest on the axis, and, where K ends with a kink, at 90 degrees. Only light that stands out of its surroundings
// meets it coherently: at most busy_flux, and at most what one ripple covers at the largest radiance left in the map
// (the threshold of the bright texels), a disc of radius 2 pi/L / 2 or a strip of width 2 pi/L along the ring.
int degree_within(const std::vector<double>& factors, const BrightSplit& map, double tolerance) {
  const double flux = map.busy_flux, radiance = std::max(map.threshold, 1e-30);
  double axis = 0, ring = 0, worst_axis = 0, worst_ring = 0;
  for (int l = static_cast<int>(factors.size()) - 1; l > 1; --l) {
    const double weight = (2 * l + 1) / (4 * pi) * factors[l];
    const double sign = l % 4 ? -1 : 1;
    axis += weight;
    if (l % 2 == 0) ring += sign * weight * std::sqrt(2 / (pi * l));  // P_l(0) for large even l
    worst_axis = std::max(worst_axis, std::abs(axis));
    worst_ring = std::max(worst_ring, std::abs(ring));
    const double ripple = 2 * pi / l;
    const double met_on_axis = std::min(flux, radiance * pi * ripple * ripple / 4 * 4);
    const double met_on_ring = std::min(flux, radiance * ripple * 2 * std::sqrt(flux / radiance));
    const double error = axis_safety * worst_axis * met_on_axis + worst_ring * met_on_ring;
    if (error > tolerance * map.mean || std::abs(factors[l]) > smallest_factor) return l;
  }
  return 1;
}

// Coefficients to twice the degree that is needed, so that the tail is known, cut to that degree.
template <class Coefficients>
KernelPlan factors_within(Coefficients&& coefficients, const BrightSplit& map, double tolerance) {
  for (int computed = 128;; computed *= 2) {
    KernelPlan plan{coefficients(computed)};
    const int degree = degree_within(plan.factors, map, tolerance);
    plan.bound_met = degree <= computed / 2;
    if (!plan.bound_met && computed < 2 * max_degree) continue;
    plan.factors.resize(std::min(degree, computed / 2) + 1);
    return plan;
  }
}

// Predicted cost in units of one multiply-add in the Legendre sums: two complex rows of three channels and the
// recurrence for every row pair, order and degree, in the map and in the grid.
double transform_cost(int degree, int map_rows) {
  return 0.5 * degree * degree * (0.5 * map_rows + degree) * 12;
}

// The same unit for a kernel integral over a texel with n nodes a side: 500 n^2. Beyond 16 nodes the patch is quartered
// around the axis until they are enough.
double integral_cost(double nodes) {
  constexpr double most = 16;
  return 500 * (nodes <= most ? nodes * nodes : most * most * (4 + 12 * std::log2(nodes / most)));
}

double core_cost(const FilterTarget& target, double near_angle, int map_rows) {
  const double texel = pi / map_rows, width = angular_width(target.kernel);
  const double covered = pi * near_angle * near_angle / (texel * texel) + 4 * near_angle / texel + 1;
  const double around_axis = std::min(covered, 9.0);
  const double most = integral_cost(patch_nodes(std::min(width, 0.25 * near_angle), texel / 2));
  const double typical = integral_cost(patch_nodes(0.25 * near_angle, texel / 2));
  return 6.0 * target.size * target.size * (around_axis * most + (covered - around_axis) * typical);
}

}  // namespace

KernelPlan plan_kernel(const FilterTarget& target, const BrightSplit& map, double tolerance) {
  const int rows = map.map->height;
  KernelPlan best = factors_within([&](int degree) { return legendre_coefficients(target.kernel, degree); },
                                   map, tolerance);
  double cost = best.bound_met ? transform_cost(static_cast<int>(best.factors.size()), rows) : INFINITY;
  const double width = angular_width(target.kernel);
  for (double near_angle = 4 * width; near_angle < 0.5 && core_cost(target, near_angle, rows) < cost;
       near_angle *= 2) {
    KernelPlan split = factors_within(
        [&](int degree) { return legendre_coefficients_of_rest(target.kernel, near_angle, degree); }, map,
        tolerance);
    const double split_cost =
        core_cost(target, near_angle, rows) + transform_cost(static_cast<int>(split.factors.size()), rows);
    if (!split.bound_met || split_cost >= cost) continue;
    cost = split_cost;
    best = std::move(split);
    best.near_angle = near_angle;
  }
  for (double& factor : best.factors) factor *= target.scale;
  return best;
}

// In any direction |sum over m of a_lm Y_lm| <= sqrt(power_l (2l + 1)/(4 pi)) (Cauchy-Schwarz and the addition
// theorem), so the sums below bound the error of dropping degrees and of interpolating (see transform.h) everywhere.
SynthesisPlan plan_synthesis(const std::vector<double>& factors, const std::vector<double>& degree_power,
                             double largest_error) {
  const int available = static_cast<int>(std::min(factors.size(), degree_power.size())) - 1;
  std::vector<double> amplitude(available + 1);
  for (int l = 0; l <= available; ++l)
    amplitude[l] = std::abs(factors[l]) * std::sqrt(degree_power[l] * (2 * l + 1) / (4 * pi));
  SynthesisPlan plan{available, 0};
  for (double dropped = 0; plan.degree > 1; --plan.degree) {
    dropped += amplitude[plan.degree];
    if (dropped > largest_error) break;
  }
  const auto interpolation_error = [&](int rows) {
    double error = 0;
    for (int l = 1; l <= plan.degree; ++l) error += amplitude[l] * 2.2e-3 * std::pow(pi * l / rows, 8);
    return error;
  };
  const auto is_smooth = [](int n) {
    for (int p : {2, 3, 5})
      while (n % p == 0) n /= p;
    return n == 1;
  };
  plan.grid_rows = std::max(16, plan.degree + 2);
  while (plan.grid_rows % 4 != 0 || !is_smooth(plan.grid_rows) ||
         interpolation_error(plan.grid_rows) > largest_error)
    ++plan.grid_rows;
  return plan;
}

}  // namespace welkin
