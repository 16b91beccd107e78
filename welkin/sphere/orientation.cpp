#include <welkin/sphere/orientation.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

// Every texel taken from where its centre comes from: exact when the orientation takes the grid to itself.
SphereMap permuted(const SphereMap& map, const Mat3& orientation) {
  const MapShape shape = map.shape();
  const Mat3 back = transposed(orientation);
  SphereMap result = make_sphere_map(shape, map.image.channels);
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      const MapPoint from = map_point(shape, back * map_texel_direction(shape, x, y));
      const int from_x = std::clamp(static_cast<int>(from.x), 0, shape.width - 1);
      const int from_y = std::clamp(static_cast<int>(from.y), 0, shape.height - 1);
      std::copy_n(map.image.at(from_x, from_y), map.image.channels, result.image.at(x, y));
    }
  }
  return result;
}

bool is_whole(double value) { return std::abs(value - std::round(value)) < 1e-9; }

bool keeps_grid(MapShape shape, double degrees) {
  switch (shape.mapping) {
    case Mapping::equirectangular: return is_whole(degrees / 360 * shape.width);
    case Mapping::cube:
    case Mapping::octahedral: return is_whole(degrees / 90);
    default: return is_whole(degrees / 360);
  }
}

}  // namespace

Mat3 rotation_about_y(double degrees) {
  if (!std::isfinite(degrees)) throw Error("the angle of a rotation must be finite");
  const double turn = std::remainder(degrees, 360.0), angle = turn * std::numbers::pi / 180;
  double c = std::cos(angle), s = std::sin(angle);
  if (is_whole(turn / 90)) {  // no 6e-17 where a zero belongs
    c = std::round(c);
    s = std::round(s);
  }
  return {{Vec3{c, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, c}}};
}

Mat3 mirror_matrix() { return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}}}; }

SphereMap oriented(const SphereMap& map, const Mat3& orientation) {
  ResampleOptions options;
  options.orientation = orientation;
  return resample(map, map.shape(), options);
}

SphereMap rotated_about_y(const SphereMap& map, double degrees) {
  const Mat3 rotation = rotation_about_y(degrees);
  return keeps_grid(map.shape(), degrees) ? permuted(map, rotation) : oriented(map, rotation);
}

SphereMap mirrored(const SphereMap& map) {
  if (map.mapping == Mapping::mirror_ball) return oriented(map, mirror_matrix());
  if (map.mapping != Mapping::dual_paraboloid) return permuted(map, mirror_matrix());
  SphereMap result = map;  // the two squares change places; also what lies outside the discs
  for (int y = 0; y < map.image.height; ++y) {
    float* row = result.image.at(0, y);
    std::rotate(row, row + static_cast<std::ptrdiff_t>(map.image.height) * map.image.channels,
                row + static_cast<std::ptrdiff_t>(map.image.width) * map.image.channels);
  }
  return result;
}

}  // namespace welkin
