#include <welkin/envmap/zonal_kernel.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include <welkin/error.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/zonal.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// D(h) = alpha^2 / (pi (cos^2 h (alpha^2 - 1) + 1)^2) with h = theta/2; sin^2 h = u/2 gives the denominator
// alpha^2 + (1 - alpha^2) u/2 without cancellation. The constant alpha^2/pi is part of the normalisation.
WELKIN_TARGET_CLONES void evaluate_ggx(double alpha, double scale, const double* u, double* out,
                                       std::size_t count) {
  const double a2 = alpha * alpha, slope = 0.5 * (1 - a2);
  for (std::size_t i = 0; i < count; ++i) {
    const double denominator = a2 + slope * u[i];
    const double cosine = u[i] < 1 ? 1 - u[i] : 0;
    out[i] = scale * cosine / (denominator * denominator);
  }
}

WELKIN_TARGET_CLONES void evaluate_lambert(double scale, const double* u, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = scale * (u[i] < 1 ? 1 - u[i] : 0);
}

void evaluate_phong(double exponent, double scale, const double* u, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    out[i] = u[i] < 1 ? scale * std::exp(exponent * std::log1p(-u[i])) : 0;
}

void evaluate_gaussian(double sigma, double scale, const double* u, double* out, std::size_t count) {
  const double factor = -0.5 / (sigma * sigma);
  for (std::size_t i = 0; i < count; ++i) {
    const double theta = 2 * std::asin(std::sqrt(std::min(1.0, 0.5 * u[i])));
    out[i] = scale * std::exp(factor * theta * theta);
  }
}

void evaluate_blinn_phong(double exponent, double scale, const double* u, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    out[i] = u[i] < 1 ? scale * (1 - u[i]) * std::exp(0.5 * exponent * std::log1p(-0.5 * u[i])) : 0;
}

void evaluate_von_mises_fisher(double kappa, double scale, const double* u, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = scale * std::exp(-kappa * u[i]);
}

void evaluate_table(const KernelTable& table, double scale, const double* u, double* out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    out[i] = scale * table.evaluate(2 * std::asin(std::sqrt(std::min(1.0, 0.5 * u[i]))));
}

double support_angle(const ZonalKernel& kernel) {
  switch (kernel.kind) {
    case KernelKind::gaussian:
    case KernelKind::von_mises_fisher: return pi;
    case KernelKind::table: return std::min(pi, kernel.table->angles.back());
    default: return pi / 2;
  }
}

// Angles at which a panel must end, because the kernel has a singularity there: the knots of tables.
double next_break(const ZonalKernel& kernel, double from, double end) {
  if (kernel.kind != KernelKind::table) return end;
  const auto& angles = kernel.table->angles;
  const auto next = std::upper_bound(angles.begin(), angles.end(), from);
  return next == angles.end() ? end : std::min(end, *next);
}

// The steepest slope of a lobe over its largest value is exp(-1/2) / sigma for a Gaussian. No wider than the table: a disc
// has no slope.
double table_width(const KernelTable& table) {
  const double largest = *std::max_element(table.values.begin(), table.values.end());
  double steepest = 1e-300;
  for (std::size_t i = 1; i < table.angles.size(); ++i)
    steepest = std::max(
        steepest, std::abs(table.values[i] - table.values[i - 1]) / (table.angles[i] - table.angles[i - 1]));
  return std::clamp(std::min(std::exp(-0.5) * largest / steepest, table.angles.back()), 1e-4, 1.0);
}

// Of a table that ends, or turns to zero, at 90 degrees: minus its slope just before.
double table_kink(const KernelTable& table) {
  const double before = table.evaluate(pi / 2 * (1 - 1e-6)), after = table.evaluate(pi / 2 * (1 + 1e-6));
  return after == 0 ? before / (pi / 2 * 1e-6) : 0;
}

// Nodes in theta over the support with weights that include 2 pi sin theta: panels of 16 Gauss-Legendre nodes, as
// narrow as half the distance to the kernel's singularity and as 12 radians of phase of P_max_degree.
QuadratureRule sphere_rule(const ZonalKernel& kernel, int max_degree) {
  const QuadratureRule panel = gauss_legendre(16);
  const double end = support_angle(kernel), width = angular_width(kernel), widest = 12.0 / (max_degree + 1);
  QuadratureRule rule;
  for (double from = 0; from < end;) {
    const double step = std::min({0.5 * std::hypot(from, width), widest, 0.25});
    const double to = std::min(next_break(kernel, from, end), from + step);
    for (std::size_t i = 0; i < panel.nodes.size(); ++i) {
      const double theta = 0.5 * (from + to) + 0.5 * (to - from) * panel.nodes[i];
      rule.nodes.push_back(theta);
      rule.weights.push_back(0.5 * (to - from) * panel.weights[i] * 2 * pi * std::sin(theta));
    }
    from = to;
  }
  return rule;
}

// k_l of the kernel times a window of theta, by the rule above.
template <class Window>
std::vector<double> project(const ZonalKernel& kernel, int max_degree, Window&& window) {
  const QuadratureRule rule = sphere_rule(kernel, max_degree);
  std::vector<double> cosines, weights;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double s = std::sin(0.5 * rule.nodes[i]);
    const double weight = rule.weights[i] * evaluate(kernel, 2 * s * s) * window(rule.nodes[i]);
    if (weight < 1e-18) continue;  // of a total of 1
    cosines.push_back(1 - 2 * s * s);
    weights.push_back(weight);
  }
  return project_zonal(cosines, weights, max_degree);
}

ZonalKernel normalized(ZonalKernel kernel) {
  const QuadratureRule rule = sphere_rule(kernel, 0);
  double integral = 0;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double s = std::sin(0.5 * rule.nodes[i]);
    integral += rule.weights[i] * evaluate(kernel, 2 * s * s);
  }
  kernel.normalization /= integral;
  return kernel;
}

}  // namespace

ZonalKernel make_ggx_kernel(double alpha) {
  if (!(alpha >= 1e-4 && alpha <= 1))
    throw Error(fmt::format("ggx alpha must lie in [0.0001, 1], not {}", alpha));
  return normalized({KernelKind::ggx, alpha});
}

ZonalKernel make_phong_kernel(double exponent) {
  if (!(exponent >= 0 && exponent <= 1e7))
    throw Error(fmt::format("the phong exponent must lie in [0, 10000000], not {}", exponent));
  return {KernelKind::phong, exponent, (exponent + 1) / (2 * pi)};
}

ZonalKernel make_lambert_kernel() { return {KernelKind::lambert, 0, 1 / pi}; }

ZonalKernel make_gaussian_kernel(double sigma_radians) {
  if (!(sigma_radians >= 1e-4 && sigma_radians <= pi))
    throw Error(fmt::format("gaussian sigma must lie in [0.0001, pi] radians, not {}", sigma_radians));
  return normalized({KernelKind::gaussian, sigma_radians});
}

ZonalKernel make_blinn_phong_kernel(double exponent) {
  if (!(exponent >= 0 && exponent <= 1e7))
    throw Error(fmt::format("the blinn-phong exponent must lie in [0, 10000000], not {}", exponent));
  return normalized({KernelKind::blinn_phong, exponent});
}

// 2 pi integral of exp(-kappa u) du over [0, 2] = 2 pi (1 - exp(-2 kappa)) / kappa.
ZonalKernel make_von_mises_fisher_kernel(double kappa) {
  if (!(kappa >= 0 && kappa <= 1e7))
    throw Error(fmt::format("vmf kappa must lie in [0, 10000000], not {}", kappa));
  const double over_kappa = kappa > 1e-12 ? -std::expm1(-2 * kappa) / kappa : 2;
  return {KernelKind::von_mises_fisher, kappa, 1 / (2 * pi * over_kappa)};
}

ZonalKernel make_table_kernel(KernelTable table) {
  const double largest = *std::max_element(table.values.begin(), table.values.end());
  return normalized(
      {KernelKind::table, 0, 1 / largest, std::make_shared<const KernelTable>(std::move(table))});
}

std::string describe(const ZonalKernel& kernel) {
  switch (kernel.kind) {
    case KernelKind::ggx: return fmt::format("ggx alpha {:.6g}", kernel.parameter);
    case KernelKind::phong: return fmt::format("phong exponent {:.6g}", kernel.parameter);
    case KernelKind::gaussian: return fmt::format("gaussian sigma {:.6g}", kernel.parameter);
    case KernelKind::blinn_phong: return fmt::format("blinn-phong exponent {:.6g}", kernel.parameter);
    case KernelKind::von_mises_fisher: return fmt::format("vmf kappa {:.6g}", kernel.parameter);
    case KernelKind::table: return fmt::format("table of {} angles", kernel.table->angles.size());
    default: return "lambert";
  }
}

void evaluate(const ZonalKernel& kernel, std::span<const double> one_minus_cos, std::span<double> out) {
  assert(out.size() >= one_minus_cos.size());
  const double* u = one_minus_cos.data();
  const std::size_t count = one_minus_cos.size();
  switch (kernel.kind) {
    case KernelKind::ggx: return evaluate_ggx(kernel.parameter, kernel.normalization, u, out.data(), count);
    case KernelKind::phong:
      return evaluate_phong(kernel.parameter, kernel.normalization, u, out.data(), count);
    case KernelKind::gaussian:
      return evaluate_gaussian(kernel.parameter, kernel.normalization, u, out.data(), count);
    case KernelKind::blinn_phong:
      return evaluate_blinn_phong(kernel.parameter, kernel.normalization, u, out.data(), count);
    case KernelKind::von_mises_fisher:
      return evaluate_von_mises_fisher(kernel.parameter, kernel.normalization, u, out.data(), count);
    case KernelKind::table: return evaluate_table(*kernel.table, kernel.normalization, u, out.data(), count);
    default: return evaluate_lambert(kernel.normalization, u, out.data(), count);
  }
}

double evaluate(const ZonalKernel& kernel, double one_minus_cos) {
  double value = 0;
  evaluate(kernel, std::span(&one_minus_cos, 1), std::span(&value, 1));
  return value;
}

double angular_width(const ZonalKernel& kernel) {
  switch (kernel.kind) {
    case KernelKind::ggx: return std::min(1.0, 2 * kernel.parameter);
    case KernelKind::phong: return 1 / std::sqrt(kernel.parameter + 1);
    case KernelKind::gaussian: return std::min(1.0, kernel.parameter);
    case KernelKind::blinn_phong: return std::min(1.0, 2 / std::sqrt(kernel.parameter + 1));
    case KernelKind::von_mises_fisher: return 1 / std::sqrt(kernel.parameter + 1);
    case KernelKind::table: return table_width(*kernel.table);
    default: return 1;
  }
}

double kink_slope(const ZonalKernel& kernel) {
  const double a2 = kernel.parameter * kernel.parameter, denominator = 0.5 * (1 + a2);
  switch (kernel.kind) {
    case KernelKind::ggx: return kernel.normalization / (denominator * denominator);
    case KernelKind::phong: return kernel.parameter < 2 ? kernel.normalization : 0;
    case KernelKind::gaussian:
    case KernelKind::von_mises_fisher: return 0;
    case KernelKind::blinn_phong: return kernel.normalization * std::exp2(-0.5 * kernel.parameter);
    case KernelKind::table: return kernel.normalization * table_kink(*kernel.table);
    default: return kernel.normalization;
  }
}

std::vector<double> legendre_coefficients(const ZonalKernel& kernel, int max_degree) {
  std::vector<double> factors = project(kernel, max_degree, [](double) { return 1.0; });
  const double total = factors[0];
  for (double& factor : factors) factor /= total;
  return factors;
}

// 1 - I(t), I the regularised incomplete beta function I_t(8, 8) = t^8 sum_k C(7+k, k) C(15, 7-k) (-t)^k.
double core_share(double t) {
  if (t >= 1) return 0;
  if (t <= 0) return 1;
  static constexpr double terms[8] = {6435, -40040, 108108, -163800, 150150, -83160, 25740, -3432};
  const bool mirrored = t > 0.5;  // I_t = 1 - I_(1-t): no cancellation near 1
  const double x = mirrored ? 1 - t : t;
  double sum = 0;
  for (int k = 7; k >= 0; --k) sum = sum * x + terms[k];
  const double x2 = x * x, x4 = x2 * x2, step = x4 * x4 * sum;
  return mirrored ? step : 1 - step;
}

std::vector<double> legendre_coefficients_of_rest(const ZonalKernel& kernel, double near_angle,
                                                  int max_degree) {
  return project(kernel, max_degree, [&](double theta) { return 1 - core_share(theta / near_angle); });
}

}  // namespace welkin
