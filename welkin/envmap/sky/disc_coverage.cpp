#include <welkin/envmap/sky/disc_coverage.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <welkin/sampling/quadrature.h>
#include <welkin/sphere/equirect.h>

// At the zenith angle t the disc covers |phi - phi_c| <= D(t),
//   cos D = (cos radius - cos t cos t_c) / (sin t sin t_c),
// so a texel's covered solid angle is the integral of sin t times the overlap of two intervals of phi. D behaves like a
// square root at the disc's top and bottom, and, if the disc contains the pole, where it starts to be a full circle; a
// substitution t = mid - half cos(tau) over each smooth panel removes the roots. The overlaps of one t add up to 2 D
// exactly, so the total does not depend on how the columns cut the disc.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

struct Disc {
  double cos_radius, theta, phi;
};

double half_width(const Disc& disc, double theta) {
  const double across = std::sin(theta) * std::sin(disc.theta);
  const double rest = disc.cos_radius - std::cos(theta) * std::cos(disc.theta);
  if (std::abs(across) < 1e-15) return rest <= 0 ? pi : 0;
  return std::acos(std::clamp(rest / across, -1.0, 1.0));
}

// Adds weight * (overlap with each column) for the interval [begin, end] of columns, a real number of columns each,
// end - begin <= row.size().
void add_interval(std::vector<double>& row, double begin, double end, double weight) {
  const int width = static_cast<int>(row.size());
  for (double x = std::floor(begin); x < end; ++x) {
    const double overlap = std::min(end, x + 1) - std::max(begin, x);
    const int column = static_cast<int>(x - std::floor(x / width) * width);
    row[column] += weight * std::max(overlap, 0.0);
  }
}

void add_panel(std::vector<double>& row, const Disc& disc, double from, double to) {
  static const QuadratureRule rule = gauss_legendre(48);
  const double width = static_cast<double>(row.size());
  const double middle = (from + to) / 2, half = (to - from) / 2;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double tau = pi * (1 + rule.nodes[i]) / 2;
    const double theta = middle - half * std::cos(tau);
    const double weight = rule.weights[i] * pi / 2 * half * std::sin(tau) * std::sin(theta) * 2 * pi / width;
    const double spread = half_width(disc, theta) * width / (2 * pi);
    const double column = (disc.phi / (2 * pi) + 0.5) * width;
    add_interval(row, column - spread, column + spread, weight);
  }
}

}  // namespace

std::vector<Coverage> disc_coverage(int width, int height, Vec3 centre, double radius) {
  const double theta = std::atan2(std::hypot(centre.x, centre.z), centre.y);
  const Disc disc{std::cos(radius), theta, std::atan2(centre.z, centre.x)};
  // Panels of smooth D, cut at the horizon: [ends[0], ends[1]] is a full circle round the pole, if there is one.
  const std::array<double, 3> ends{std::max(0.0, theta - radius) > 0 ? theta - radius : 0.0,
                                   std::abs(theta - radius), theta + radius};
  std::vector<Coverage> result;
  std::vector<double> row(width);
  const double step = pi / height;
  const int first = static_cast<int>(ends[0] / step);
  const int last = std::min(static_cast<int>(std::min(ends[2], pi / 2) / step), height - 1);
  for (int y = first; y <= last; ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int panel = 0; panel < 2; ++panel) {
      const double from = std::max(y * step, ends[panel]);
      const double to = std::min({(y + 1) * step, ends[panel + 1], pi / 2});
      if (to > from) add_panel(row, disc, from, to);
    }
    const double solid_angle = equirect_texel_solid_angle(width, height, y);
    for (int x = 0; x < width; ++x)
      if (row[x] > 0) result.push_back({x, y, std::min(row[x] / solid_angle, 1.0)});
  }
  return result;
}

}  // namespace welkin
