#include <welkin/brdf/lobe_fit.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <welkin/brdf/lobe_energy.h>
#include <welkin/brdf/lobe_rings.h>
#include <welkin/error.h>

// For an axis and what the other lobes leave, r, the squared error of a lobe K about it is, ring by ring,
//   sum of w s (mean(r^2) - 2 K mean(r) + K^2),
// w the solid angle of a ring and s the share of it that counts. So the means are all that a fit needs: K = mean(r) is the
// best free shape, and the best axis is where what is left, the variance within rings, is smallest.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

void check(std::span<const double> view_angles, const LobeFitOptions& options, int most_lobes) {
  if (options.lobes < 1 || options.lobes > most_lobes)
    throw Error(fmt::format("the number of lobes must lie in [1, {}], not {}", most_lobes, options.lobes));
  for (double angle : view_angles)
    if (!(angle >= 0 && angle < pi / 2))
      throw Error(fmt::format("view angles must lie in [0, pi/2), not {:g}", angle));
}

// The place in [low, high] where `value` is smallest, by golden sections; it has to have one minimum there.
double golden_minimum(double low, double high, double tolerance, const std::function<double(double)>& value) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = value(a), at_b = value(b);
  while (high - low > tolerance) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - ratio * (high - low), at_a = value(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + ratio * (high - low), at_b = value(b);
    }
  }
  return (low + high) / 2;
}

// K of a family, not normalised, at the nodes.
std::vector<double> family_shape(LobeFamily family, double parameter, const RingNodes& nodes) {
  std::vector<double> values;
  for (double angle : nodes.angles) {
    const double s = std::sin(angle / 2), u = 2 * s * s;
    if (angle >= pi / 2) {
      values.push_back(0);
    } else if (family == LobeFamily::ggx) {
      const double a2 = parameter * parameter, d = a2 + (1 - a2) * u / 2;
      values.push_back((1 - u) * a2 * a2 / (d * d));
    } else {
      values.push_back(std::exp(parameter * std::log1p(-u)));
    }
  }
  return values;
}

// <a, b> over the part of the sphere that counts.
double inner(const RingNodes& nodes, const RingMeans& means, const std::vector<double>& a,
             const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += nodes.weights[k] * means.share[k] * a[k] * b[k];
  return sum;
}

// The best lobe of the family for these means, and the squared error that it leaves.
struct ShapeFit {
  double error = 0, parameter = 0;
  std::vector<double> values;
};

double squared_error(const RingNodes& nodes, const RingMeans& means, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    sum +=
        nodes.weights[k] * means.share[k] * (means.square[k] + values[k] * (values[k] - 2 * means.mean[k]));
  return sum;
}

ShapeFit fit_free(const RingNodes& nodes, const RingMeans& means) {
  ShapeFit fit{0, 0, means.mean};
  for (double& value : fit.values) value = std::max(0.0, value);
  fit.error = squared_error(nodes, means, fit.values);
  return fit;
}

// The shape times the best factor >= 0.
ShapeFit fit_scale(const RingNodes& nodes, const RingMeans& means, double parameter,
                   std::vector<double> shape) {
  const double norm = inner(nodes, means, shape, shape);
  const double factor = norm > 0 ? std::max(0.0, inner(nodes, means, means.mean, shape) / norm) : 0;
  for (double& value : shape) value *= factor;
  return {squared_error(nodes, means, shape), parameter, std::move(shape)};
}

// alpha from exp(-x), N = exp(2 x) - 1: both get narrower with x.
double parameter_of(LobeFamily family, double x) {
  return family == LobeFamily::ggx ? std::exp(-x) : std::exp(2 * x) - 1;
}

ShapeFit fit_shape(const RingNodes& nodes, const RingMeans& means, LobeFamily family) {
  if (family == LobeFamily::free) return fit_free(nodes, means);
  const double narrowest = std::log(1 / std::max(nodes.angles[1], 1e-3));
  const auto fit_at = [&](double x) {
    const double parameter = parameter_of(family, x);
    return fit_scale(nodes, means, parameter, family_shape(family, parameter, nodes));
  };
  return fit_at(golden_minimum(0, narrowest, 1e-4, [&](double x) { return fit_at(x).error; }));
}

// Where the residual is brightest in the plane of incidence.
double brightest_axis(const LobeSlice& slice, const RingNodes& nodes, const std::vector<WorkingLobe>& others,
                      double width) {
  const int steps = std::clamp(static_cast<int>(4 * pi / width), 64, 4000);
  double best = 0, largest = -1;
  for (int i = 1; i < steps; ++i) {
    const double axis = pi * i / steps - pi / 2;
    double value = slice.luminance(lobe_axis(axis));
    for (const WorkingLobe& lobe : others) value -= shape_at(nodes, lobe.values, std::abs(axis - lobe.axis));
    if (value > largest) largest = value, best = axis;
  }
  return best;
}

// The axis near `start` for which the squared error is smallest: a scan of `reach` steps of half a width to both sides, then
// golden sections to a hundredth of the width, which costs 1e-4 of the lobe.
double best_axis(double start, double width, int reach, const std::function<double(double)>& error) {
  const double step = std::min(width, 0.3) / 2, limit = pi / 2;
  double best = start, smallest = std::numeric_limits<double>::infinity();
  for (int i = -reach; i <= reach; ++i) {
    const double axis = std::clamp(start + i * step, -limit, limit), value = error(axis);
    if (value < smallest) smallest = value, best = axis;
  }
  return golden_minimum(std::max(best - step, -limit), std::min(best + step, limit), 0.02 * step, error);
}

WorkingLobe fit_one(const LobeSlice& slice, const RingNodes& nodes, const std::vector<WorkingLobe>& others,
                    LobeFamily family, double start, double width, int reach) {
  const auto fit_at = [&](double axis) {
    return fit_shape(nodes, ring_means(slice, nodes, others, axis), family);
  };
  const double axis = best_axis(start, width, reach, [&](double at) { return fit_at(at).error; });
  ShapeFit fit = fit_at(axis);
  return {axis, fit.parameter, std::move(fit.values)};
}

constexpr int passes = 2;                      // of fitting several lobes anew
constexpr int wide_reach = 4, near_reach = 1;  // steps: from a guess, from a neighbour's or an earlier axis

// `previous`: the lobes of the view before, turned by the difference; empty for the first.
std::vector<WorkingLobe> fit_view(const LobeSlice& slice, const RingNodes& nodes,
                                  const LobeFitOptions& options, double width,
                                  const std::vector<double>& previous) {
  std::vector<WorkingLobe> lobes;
  for (int j = 0; j < options.lobes; ++j) {
    const double start = previous.empty() ? brightest_axis(slice, nodes, lobes, width) : previous[j];
    lobes.push_back(fit_one(slice, nodes, lobes, options.family, start, width,
                            previous.empty() ? wide_reach : near_reach));
  }
  for (int pass = 0; pass < passes && options.lobes > 1; ++pass)
    for (int j = 0; j < options.lobes; ++j) {
      std::vector<WorkingLobe> others = lobes;
      others.erase(others.begin() + j);
      lobes[j] = fit_one(slice, nodes, others, options.family, lobes[j].axis, width, near_reach);
    }
  return lobes;
}

// The angle of the view in a fan of views: the solid angle between the middles to its neighbours.
double view_weight(std::span<const double> angles, std::size_t i) {
  const double low = i == 0 ? 0 : (angles[i - 1] + angles[i]) / 2;
  const double high = i + 1 == angles.size() ? pi / 2 : (angles[i] + angles[i + 1]) / 2;
  return std::cos(low) - std::cos(high);
}

// Of the whole lobe, as if the rings' parts that do not count were like those that do.
double energy_of(const RingNodes& nodes, const RingMeans& means) {
  double sum = 0;
  for (std::size_t k = 0; k < means.mean.size(); ++k) sum += nodes.weights[k] * means.mean[k];
  return sum;
}

// The mean of all views' ring means, each of energy 1, as a shape of the family.
WorkingLobe shared_shape(const IsotropicBrdf& brdf, std::span<const double> view_angles,
                         const LobeFitOptions& options, const RingNodes& nodes,
                         const std::vector<double>& axes) {
  RingMeans mean(nodes.angles.size());
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const RingMeans means = ring_means(LobeSlice(brdf, view_angles[i], options.target), nodes, {}, axes[i]);
    const double energy = energy_of(nodes, means);
    if (!(energy > 0)) continue;
    const double weight = view_weight(view_angles, i);
    for (std::size_t k = 0; k < means.mean.size(); ++k) {
      mean.mean[k] += weight * means.share[k] * means.mean[k] / energy;
      mean.share[k] += weight * means.share[k];
    }
  }
  for (std::size_t k = 0; k < mean.mean.size(); ++k)
    if (mean.share[k] > 0) mean.mean[k] /= mean.share[k];
  ShapeFit fit = fit_shape(nodes, mean, options.family);
  return {0, fit.parameter, std::move(fit.values)};
}

}  // namespace

std::vector<double> lobe_angles(const IsotropicBrdf& brdf) { return RingNodes(brdf.angular_width).angles; }

std::vector<LobeFit> fit_lobes(const IsotropicBrdf& brdf, std::span<const double> view_angles,
                               const LobeFitOptions& options) {
  check(view_angles, options, 4);
  const RingNodes nodes(brdf.angular_width);
  std::vector<LobeFit> fits;
  std::vector<double> axes;
  for (double view_angle : view_angles) {
    if (!fits.empty())
      for (double& axis : axes) axis += view_angle - fits.back().view_angle;
    const LobeSlice slice(brdf, view_angle, options.target);
    const auto lobes = fit_view(slice, nodes, options, brdf.angular_width, axes);
    axes.clear();
    for (const WorkingLobe& lobe : lobes) axes.push_back(lobe.axis);
    fits.push_back(with_energies(slice, nodes, lobes, options.target));
    fits.back().view_angle = view_angle;
  }
  return fits;
}

std::vector<LobeFit> fit_single_lobe(const IsotropicBrdf& brdf, std::span<const double> view_angles,
                                     const LobeFitOptions& options) {
  check(view_angles, options, 1);
  const RingNodes nodes(brdf.angular_width);
  std::vector<double> axes;  // to begin with, those of each view's own shape
  for (const LobeFit& fit : fit_lobes(brdf, view_angles, {1, LobeFamily::free, options.target}))
    axes.push_back(fit.lobes[0].axis);
  WorkingLobe shared = shared_shape(brdf, view_angles, options, nodes, axes);
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const LobeSlice slice(brdf, view_angles[i], options.target);
      axes[i] = best_axis(axes[i], brdf.angular_width, near_reach, [&](double axis) {
        const RingMeans means = ring_means(slice, nodes, {}, axis);
        return fit_scale(nodes, means, 0, shared.values).error;
      });
    }
    shared = shared_shape(brdf, view_angles, options, nodes, axes);
  }
  std::vector<LobeFit> fits;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    shared.axis = axes[i];
    fits.push_back(
        with_energies(LobeSlice(brdf, view_angles[i], options.target), nodes, {shared}, options.target));
    fits.back().view_angle = view_angles[i];
  }
  return fits;
}

}  // namespace welkin
