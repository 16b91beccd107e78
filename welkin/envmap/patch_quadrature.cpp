#include <welkin/envmap/patch_quadrature.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr int max_nodes = 16;

const QuadratureRule& rule_of(int nodes) {
  static const std::array<QuadratureRule, max_nodes + 1> rules = [] {
    std::array<QuadratureRule, max_nodes + 1> made;
    for (int n = 1; n <= max_nodes; ++n) made[n] = gauss_legendre(n);
    return made;
  }();
  return rules[nodes];
}

Vec3 direction_of(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

double integrate_with_nodes(const ZonalKernel& kernel, Vec3 direction, const SpherePatch& patch,
                            double near_angle, int nodes) {
  const QuadratureRule& rule = rule_of(nodes);
  const double half_theta = 0.5 * (patch.theta1 - patch.theta0), half_phi = 0.5 * (patch.phi1 - patch.phi0);
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double theta = 0.5 * (patch.theta0 + patch.theta1) + half_theta * rule.nodes[i];
    double u[max_nodes], values[max_nodes], row = 0;
    for (int j = 0; j < nodes; ++j) {
      const Vec3 d =
          direction_of(theta, 0.5 * (patch.phi0 + patch.phi1) + half_phi * rule.nodes[j]) - direction;
      u[j] = std::min(2.0, 0.5 * dot(d, d));
    }
    evaluate(kernel, std::span(u, nodes), std::span(values, nodes));
    for (int j = 0; j < nodes; ++j) {
      const double share = near_angle > 0 ? core_share(2 * std::asin(std::sqrt(0.5 * u[j])) / near_angle) : 1;
      row += rule.weights[j] * values[j] * share;
    }
    sum += rule.weights[i] * std::sin(theta) * row;
  }
  return half_theta * half_phi * sum;
}

// Weighted sum of K sin theta over a Gauss rule on [from, to] along one angle, the other angle fixed.
template <class DirectionAt>
double integrate_piece(const ZonalKernel& kernel, Vec3 axis, double from, double to,
                       DirectionAt&& direction_at) {
  constexpr int nodes = 4;
  const QuadratureRule& rule = rule_of(nodes);
  double u[nodes], values[nodes], sines[nodes], sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const Vec3 d = direction_at(0.5 * (from + to) + 0.5 * (to - from) * rule.nodes[i]);
    sines[i] = std::hypot(d.x, d.z);
    u[i] = std::clamp(1 - dot(d, axis), 0.0, 2.0);
  }
  evaluate(kernel, std::span(u, nodes), std::span(values, nodes));
  for (int i = 0; i < nodes; ++i) sum += rule.weights[i] * values[i] * sines[i];
  return 0.5 * (to - from) * sum;
}

// Along a meridian cos gamma = a cos theta + b sin theta, zero once in (0, pi).
double horizon_theta(Vec3 axis, double phi) {
  const double b = axis.x * std::cos(phi) + axis.z * std::sin(phi);
  const double theta = std::atan2(-axis.y, b);
  return theta < 0 ? theta + std::numbers::pi : theta;
}

// Along a parallel cos gamma = A + B cos(phi - phi_axis), zero at phi_axis +- acos(-A/B): the zeros inside (from, to),
// in order; those outside are moved to its ends.
std::array<double, 2> horizon_phis(Vec3 axis, double theta, double from, double to) {
  const double b = std::sin(theta) * std::hypot(axis.x, axis.z);
  const double ratio = b > 0 ? -std::cos(theta) * axis.y / b : 2;
  if (std::abs(ratio) >= 1) return {from, from};
  const double axis_phi = std::atan2(axis.z, axis.x), away = std::acos(ratio);
  const auto inside = [&](double phi) {
    const double turns = std::round((0.5 * (from + to) - phi) / (2 * std::numbers::pi));
    return std::clamp(phi + turns * 2 * std::numbers::pi, from, to);
  };
  const double a = inside(axis_phi - away), c = inside(axis_phi + away);
  return {std::min(a, c), std::max(a, c)};
}

// A patch that lies across the kernel's end at 90 degrees: lines along the angle in which the end is crossed faster are
// cut where they cross it, so that each piece is smooth.
double integrate_across_end(const ZonalKernel& kernel, Vec3 axis, const SpherePatch& p) {
  constexpr int lines = 5;
  const QuadratureRule& rule = rule_of(lines);
  const double theta = 0.5 * (p.theta0 + p.theta1), phi = 0.5 * (p.phi0 + p.phi1);
  const double half_theta = 0.5 * (p.theta1 - p.theta0), half_phi = 0.5 * (p.phi1 - p.phi0);
  const double along = axis.x * std::cos(phi) + axis.z * std::sin(phi);
  const double by_theta = half_theta * std::abs(-axis.y * std::sin(theta) + along * std::cos(theta));
  const double by_phi =
      half_phi * std::abs(std::sin(theta) * (axis.z * std::cos(phi) - axis.x * std::sin(phi)));
  double sum = 0;
  for (int i = 0; i < lines; ++i) {
    if (by_theta > by_phi) {
      const double at = phi + half_phi * rule.nodes[i],
                   cut = std::clamp(horizon_theta(axis, at), p.theta0, p.theta1);
      const auto line = [&](double t) { return direction_of(t, at); };
      sum += half_phi * rule.weights[i] *
             (integrate_piece(kernel, axis, p.theta0, cut, line) +
              integrate_piece(kernel, axis, cut, p.theta1, line));
    } else {
      const double at = theta + half_theta * rule.nodes[i];
      const std::array<double, 2> cuts = horizon_phis(axis, at, p.phi0, p.phi1);
      const auto line = [&](double f) { return direction_of(at, f); };
      sum += half_theta * rule.weights[i] *
             (integrate_piece(kernel, axis, p.phi0, cuts[0], line) +
              integrate_piece(kernel, axis, cuts[0], cuts[1], line) +
              integrate_piece(kernel, axis, cuts[1], p.phi1, line));
    }
  }
  return sum;
}

// In two or in four. A patch more than twice as long as wide is cut across: quartered, the wedges at a pole would double
// in number from one step to the next.
std::vector<SpherePatch> parts_of(const SpherePatch& p) {
  const double theta = 0.5 * (p.theta0 + p.theta1), phi = 0.5 * (p.phi0 + p.phi1);
  const double high = p.theta1 - p.theta0, wide = (p.phi1 - p.phi0) * std::sin(theta);
  if (high > 2 * wide) return {{p.theta0, theta, p.phi0, p.phi1}, {theta, p.theta1, p.phi0, p.phi1}};
  if (wide > 2 * high) return {{p.theta0, p.theta1, p.phi0, phi}, {p.theta0, p.theta1, phi, p.phi1}};
  return {{p.theta0, theta, p.phi0, phi},
          {theta, p.theta1, p.phi0, phi},
          {p.theta0, theta, phi, p.phi1},
          {theta, p.theta1, phi, p.phi1}};
}

}  // namespace

SpherePatch equirect_patch(int width, int height, int x, int y) {
  const double pi = std::numbers::pi;
  return {pi * y / height, pi * (y + 1) / height, 2 * pi * x / width - pi, 2 * pi * (x + 1) / width - pi};
}

int patch_nodes(double singularity_distance, double half_width) {
  const double ratio = singularity_distance / half_width;
  const double log_rho = std::asinh(ratio);
  return std::max(2, static_cast<int>(std::ceil(9.2 / log_rho)));  // 2 * 9.2 = ln 1e8
}

double integrate_kernel(const ZonalKernel& kernel, Vec3 direction, const SpherePatch& patch,
                        double near_angle) {
  const double theta = 0.5 * (patch.theta0 + patch.theta1), phi = 0.5 * (patch.phi0 + patch.phi1);
  const double half =
      std::max(0.5 * (patch.theta1 - patch.theta0), 0.5 * (patch.phi1 - patch.phi0) * std::sin(theta));
  const double to_centre = length(direction_of(theta, phi) - direction);
  const double distance = std::max(0.0, to_centre - std::numbers::sqrt2 * half);
  if (near_angle > 0 && distance >= near_angle) return 0;  // the window ends before it
  const bool across_end = std::abs(1 - 0.5 * to_centre * to_centre) < 1.6 * half;
  if (across_end && near_angle == 0 && kink_slope(kernel) > steep_kink && angular_width(kernel) > half)
    return integrate_across_end(kernel, direction, patch);
  // The window varies over about a quarter of its angle.
  const double window = near_angle > 0 ? 0.25 * near_angle : 10.0;
  const int nodes = patch_nodes(std::min(window, std::hypot(distance, angular_width(kernel))), half);
  if (nodes <= max_nodes) return integrate_with_nodes(kernel, direction, patch, near_angle, nodes);
  double sum = 0;
  for (const SpherePatch& part : parts_of(patch))
    sum += integrate_kernel(kernel, direction, part, near_angle);
  return sum;
}

}  // namespace welkin
