#include <welkin/sphere/sphere_points.h>

#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/sampling/sequence.h>

namespace welkin {

std::vector<Vec3> sphere_points(int count, std::uint64_t seed) {
  assert(count >= 0);
  std::vector<Vec3> points(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [u, v] = r2_point(i, seed);
    const double phi = 2 * std::numbers::pi * u;
    const double radius = 2 * std::sqrt(v * (1 - v));  // sqrt(1 - (1 - 2 v)^2)
    points[i] = {radius * std::cos(phi), 1 - 2 * v, radius * std::sin(phi)};
  }
  return points;
}

}  // namespace welkin
