#include <welkin/envmap/methods/kernel_quantiles.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/sampling/quadrature.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

// From 1e-2 of the width, where a kernel is still flat, in steps of 2 %; 90 degrees, where kernels may end, is an edge.
std::vector<double> cell_edges(double width) {
  std::vector<double> angles{0};
  for (double angle = 1e-2 * std::min(width, 1.0); angle < pi; angle *= 1.02) angles.push_back(angle);
  angles.push_back(pi / 2);
  angles.push_back(pi);
  std::sort(angles.begin(), angles.end());
  return angles;
}

double one_minus_cosine(double angle) {
  const double s = std::sin(angle / 2);
  return 2 * s * s;
}

}  // namespace

KernelQuantiles::KernelQuantiles(const ZonalKernel& kernel) {
  const std::vector<double> angles = cell_edges(angular_width(kernel));
  const QuadratureRule rule = gauss_legendre(4);
  std::vector<double> energy;
  for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
    const double half = (angles[i + 1] - angles[i]) / 2, middle = (angles[i + 1] + angles[i]) / 2;
    double sum = 0;
    for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
      const double angle = middle + half * rule.nodes[k];
      sum += rule.weights[k] * evaluate(kernel, one_minus_cosine(angle)) * std::sin(angle);
    }
    energy.push_back(2 * pi * half * sum);
  }
  for (double angle : angles) u_.push_back(one_minus_cosine(angle));
  inside_.assign(u_.size(), 0);
  outside_.assign(u_.size(), 0);
  for (std::size_t i = 0; i < energy.size(); ++i) inside_[i + 1] = inside_[i] + energy[i];
  for (std::size_t i = energy.size(); i-- > 0;) outside_[i] = outside_[i + 1] + energy[i];
  const double total = inside_.back();
  for (double& share : inside_) share /= total;
  for (double& share : outside_) share /= total;
}

double KernelQuantiles::one_minus_cos(double share) const {
  const auto above = std::upper_bound(inside_.begin(), inside_.end(), share) - inside_.begin();
  const std::size_t i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(inside_.size()) - 1));
  const double width = inside_[i] - inside_[i - 1];
  const double t = width > 0 ? std::clamp((share - inside_[i - 1]) / width, 0.0, 1.0) : 0;
  return u_[i - 1] + t * (u_[i] - u_[i - 1]);
}

double KernelQuantiles::share(double one_minus_cos) const {
  const auto above = std::upper_bound(u_.begin(), u_.end(), one_minus_cos) - u_.begin();
  const std::size_t i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above, 1, static_cast<std::ptrdiff_t>(u_.size()) - 1));
  const double t = std::clamp((one_minus_cos - u_[i - 1]) / (u_[i] - u_[i - 1]), 0.0, 1.0);
  return inside_[i - 1] + t * (inside_[i] - inside_[i - 1]);
}

// From the outside, so that a tail of 1e-12 is not lost in what lies within.
double KernelQuantiles::angle_with_tail(double share) const {
  std::size_t i = u_.size() - 1;
  while (i > 0 && outside_[i - 1] <= share) --i;
  if (i == 0) return 0;
  const double width = outside_[i - 1] - outside_[i];
  const double t = width > 0 ? (outside_[i - 1] - share) / width : 1;
  const double u = u_[i - 1] + t * (u_[i] - u_[i - 1]);
  return 2 * std::asin(std::sqrt(std::min(1.0, u / 2)));
}

}  // namespace welkin
