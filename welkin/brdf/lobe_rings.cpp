#include <welkin/brdf/lobe_rings.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int intervals = 96;  // even, for Simpson's rule

// Their sines and cosines, once for all.
const std::array<std::array<double, 2>, ring_points>& ring_directions() {
  static const auto directions = [] {
    std::array<std::array<double, 2>, ring_points> table{};
    for (int m = 0; m < ring_points; ++m) {
      const double phi = pi * (m + 0.5) / ring_points;
      table[m] = {std::cos(phi), std::sin(phi)};
    }
    return table;
  }();
  return directions;
}

}  // namespace

// angle = w sinh(t asinh(pi / w)), t even in [0, 1]: steps of w / 20 or so near the axis, growing with the angle.
// Simpson's rule in t, times d angle / dt and 2 pi sin(angle).
RingNodes::RingNodes(double angular_width) {
  const double w = std::clamp(angular_width, 1e-4, 1.0), stretch = std::asinh(pi / w);
  for (int k = 0; k <= intervals; ++k) {
    const double t = static_cast<double>(k) / intervals;
    const double angle = k == intervals ? pi : w * std::sinh(t * stretch);
    const double simpson = (k == 0 || k == intervals ? 1 : k % 2 ? 4 : 2) / (3.0 * intervals);
    angles.push_back(angle);
    weights.push_back(simpson * w * stretch * std::cosh(t * stretch) * 2 * pi * std::sin(angle));
  }
}

LobeSlice::LobeSlice(const IsotropicBrdf& brdf, double view_angle, LobeTarget target)
    : brdf_(brdf), cos_view_(std::cos(view_angle)), target_(target) {}

std::array<double, 3> LobeSlice::value(LocalVec light) const {
  if (light.z <= 0) return {};
  auto f = brdf_.value(std::min(1.0, light.z), cos_view_, std::atan2(std::abs(light.y), light.x));
  if (target_ == LobeTarget::brdf_times_cosine)
    for (double& channel : f) channel *= light.z;
  return f;
}

double LobeSlice::luminance(LocalVec light) const {
  const auto rgb = value(light);
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

bool LobeSlice::counts(LocalVec light) const {
  return target_ == LobeTarget::brdf_times_cosine || light.z > 0;
}

LocalVec lobe_axis(double axis) { return {-std::sin(axis), 0, std::cos(axis)}; }

LocalVec ring_point(double axis, double angle, int m) {
  const double ca = std::cos(axis), sa = std::sin(axis), c = std::cos(angle), s = std::sin(angle);
  const auto [cos_phi, sin_phi] = ring_directions()[m];
  return {-sa * c + ca * s * cos_phi, s * sin_phi, ca * c + sa * s * cos_phi};
}

double shape_at(const RingNodes& nodes, const std::vector<double>& values, double angle) {
  const auto after = std::upper_bound(nodes.angles.begin(), nodes.angles.end(), angle);
  const std::size_t k = std::clamp<std::size_t>(after - nodes.angles.begin(), 1, nodes.angles.size() - 1);
  const double share = (angle - nodes.angles[k - 1]) / (nodes.angles[k] - nodes.angles[k - 1]);
  return values[k - 1] + std::clamp(share, 0.0, 1.0) * (values[k] - values[k - 1]);
}

RingMeans ring_means(const LobeSlice& slice, const RingNodes& nodes, const std::vector<WorkingLobe>& others,
                     double axis) {
  RingMeans means(nodes.angles.size());
  parallel_for(nodes.angles.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      double sum = 0, squares = 0;
      int counted = 0;
      for (int m = 0; m < ring_points; ++m) {
        const LocalVec light = ring_point(axis, nodes.angles[k], m);
        if (!slice.counts(light)) continue;
        ++counted;
        double rest = slice.luminance(light);
        for (const WorkingLobe& lobe : others) {
          const double cosine = std::clamp(dot(light, lobe_axis(lobe.axis)), -1.0, 1.0);
          rest -= shape_at(nodes, lobe.values, std::acos(cosine));
        }
        sum += rest;
        squares += rest * rest;
      }
      if (counted == 0) continue;
      means.mean[k] = sum / counted;
      means.square[k] = squares / counted;
      means.share[k] = static_cast<double>(counted) / ring_points;
    }
  });
  return means;
}

}  // namespace welkin
