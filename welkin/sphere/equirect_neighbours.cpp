// With the direction at colatitude t, longitude p and a texel at t', p', chord^2 = 2 - 2 cos(angle) and
//   cos(angle) = sin t sin t' cos(p' - p) + cos t cos t'.
// So a row t' has the columns with cos(p' - p) > (1 - radius^2 / 2 - cos t cos t') / (sin t sin t'): all of them when
// the right side is below -1 (near the poles), none when it is 1 or more.
#include <welkin/sphere/equirect_neighbours.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/sphere/equirect.h>

namespace welkin {

namespace {
constexpr double pi = std::numbers::pi;
}

EquirectNeighbours::EquirectNeighbours(MapShape shape) : shape_(shape) {
  for (int y = 0; y < shape.height; ++y) {
    const double theta = pi * (y + 0.5) / shape.height;
    cos_theta_.push_back(std::cos(theta));
    sin_theta_.push_back(std::sin(theta));
    solid_angle_.push_back(equirect_texel_solid_angle(shape.width, shape.height, y));
  }
  for (int x = 0; x < shape.width; ++x) {
    const double phi = 2 * pi * ((x + 0.5) / shape.width - 0.5);
    cos_phi_.push_back(std::cos(phi));
    sin_phi_.push_back(std::sin(phi));
  }
}

double EquirectNeighbours::append(Vec3 d, double radius, std::vector<TexelWeight>& weights) const {
  const Uv centre = equirect_uv(d);
  const double across = std::hypot(d.x, d.z), scale = 1 / (radius * radius),
               nearest = 1 - radius * radius / 2;
  const double reach = 2 * std::asin(std::min(1.0, radius / 2)) / pi * shape_.height;
  const double middle = centre.v * shape_.height - 0.5;
  const int first_row = std::max(0, static_cast<int>(std::floor(middle - reach)));
  const int last_row = std::min(shape_.height - 1, static_cast<int>(std::ceil(middle + reach)));
  double total = 0;
  for (int y = first_row; y <= last_row; ++y) {
    const auto row = static_cast<std::size_t>(y);
    const double along = cos_theta_[row] * d.y, level = sin_theta_[row] * across;
    if (nearest - along >= level) continue;
    int first = 0, count = shape_.width;
    if (nearest - along > -level) {
      const double half = std::acos((nearest - along) / level) / (2 * pi) * shape_.width;
      const double column = centre.u * shape_.width - 0.5;
      first = static_cast<int>(std::floor(column - half));
      count = std::min(shape_.width, static_cast<int>(std::ceil(column + half)) - first + 1);
    }
    const double x_part = sin_theta_[row] * d.x, z_part = sin_theta_[row] * d.z;
    int x = first < 0 ? first + shape_.width : first;
    for (int i = 0; i < count; ++i, ++x) {
      if (x >= shape_.width) x -= shape_.width;
      const auto k = static_cast<std::size_t>(x);
      const double chord2 = 2 - 2 * (x_part * cos_phi_[k] + z_part * sin_phi_[k] + along);
      const double rest = 1 - scale * chord2;
      if (rest <= 0) continue;
      const double weight = rest * rest * rest * solid_angle_[row];
      weights.push_back({x, y, weight});
      total += weight;
    }
  }
  return total;
}

}  // namespace welkin
