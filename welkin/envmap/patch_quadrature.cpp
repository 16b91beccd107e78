#include <welkin/envmap/patch_quadrature.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

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
  // The window varies over about a quarter of its angle.
  const double window = near_angle > 0 ? 0.25 * near_angle : 10.0;
  const int nodes = patch_nodes(std::min(window, std::hypot(distance, angular_width(kernel))), half);
  if (nodes <= max_nodes) return integrate_with_nodes(kernel, direction, patch, near_angle, nodes);
  double sum = 0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const bool lower = quarter & 1, right = quarter & 2;
    sum += integrate_kernel(kernel, direction,
                            {lower ? theta : patch.theta0, lower ? patch.theta1 : theta,
                             right ? phi : patch.phi0, right ? patch.phi1 : phi},
                            near_angle);
  }
  return sum;
}

}  // namespace welkin
