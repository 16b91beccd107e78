#include <welkin/sphere/mapping.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include <welkin/error.h>
#include <welkin/sphere/cube.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

// A point of a unit square's disc or diamond: a rightwards, b upwards (downwards for octahedral), in [-1, 1].
struct Plane {
  double a = 0, b = 0;
};

Plane plane_of(int size, int x, int y, double fx, double fy) {
  return {2 * (x + fx) / size - 1, 1 - 2 * (y + fy) / size};
}

// Stereographic projection from -axis: with r^2 = a^2 + b^2, d = (2a, 2b, 1 - r^2) / (1 + r^2).
Vec3 paraboloid_direction(Plane p, double side) {
  const double r2 = p.a * p.a + p.b * p.b, scale = 1 / (1 + r2);
  return {2 * p.a * scale, 2 * p.b * scale, side * (1 - r2) * scale};
}

// Reflection of the viewer's direction +Z about the normal n = (a, b, sqrt(1 - r^2)): d = 2 n.z n - z.
Vec3 ball_direction(Plane p) {
  const double r2 = p.a * p.a + p.b * p.b;
  if (r2 >= 1) return {0, 0, -1};
  const double nz = std::sqrt(1 - r2);
  return {2 * nz * p.a, 2 * nz * p.b, 1 - 2 * r2};
}

// n = (d + z) / |d + z|. Near -Z the sum cancels: there 1 + z = (x^2 + y^2) / (1 - z) keeps all digits.
Plane ball_plane(Vec3 d) {
  const double xy2 = d.x * d.x + d.y * d.y;
  const double w = d.z > 0 ? 1 + d.z : xy2 / (1 - d.z);
  const double norm = std::sqrt(xy2 + w * w);
  return norm > 0 ? Plane{d.x / norm, d.y / norm} : Plane{1, 0};
}

double sign(double value) { return std::signbit(value) ? -1.0 : 1.0; }

Vec3 octahedral_direction(double u, double v) {
  const double y = 1 - std::abs(u) - std::abs(v);
  if (y >= 0) return normalized({u, y, v});
  return normalized({sign(u) * (1 - std::abs(v)), y, sign(v) * (1 - std::abs(u))});
}

MapPoint octahedral_point(int size, Vec3 d) {
  const double scale = 1 / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  double u = d.x * scale, v = d.z * scale;
  int chart = 0;
  if (d.y < 0) {
    const double folded_u = sign(u) * (1 - std::abs(v));
    v = sign(v) * (1 - std::abs(u));
    u = folded_u;
    chart = 1 + (std::signbit(u) ? 1 : 0) + (std::signbit(v) ? 2 : 0);
  }
  return {(u + 1) / 2 * size, (v + 1) / 2 * size, chart};
}

MapPoint cube_map_point(int size, Vec3 direction) {
  const CubePoint p = cube_point(direction);
  return {(p.s + 1) / 2 * size, (p.face + (p.t + 1) / 2) * size, p.face + 1};
}

MapPoint paraboloid_point(int size, Vec3 d) {
  const double scale = 1 / (1 + std::abs(d.z));
  const int half = d.z >= 0 ? 0 : 1;
  return {(d.x * scale + 1) / 2 * size + half * size, (1 - d.y * scale) / 2 * size, half + 1};
}

}  // namespace

std::string_view mapping_name(Mapping mapping) {
  constexpr std::string_view names[] = {"equirectangular", "cube", "dual-paraboloid", "mirror-ball",
                                        "octahedral"};
  return names[static_cast<int>(mapping)];
}

std::optional<Mapping> mapping_from_name(std::string_view name) {
  for (Mapping mapping : all_mappings) {
    if (name == mapping_name(mapping)) return mapping;
  }
  constexpr std::pair<std::string_view, Mapping> short_names[] = {{"equirect", Mapping::equirectangular},
                                                                  {"latlong", Mapping::equirectangular},
                                                                  {"paraboloid", Mapping::dual_paraboloid},
                                                                  {"sphere-map", Mapping::mirror_ball},
                                                                  {"octa", Mapping::octahedral}};
  for (const auto& entry : short_names) {
    if (name == entry.first) return entry.second;
  }
  return std::nullopt;
}

MapShape map_shape(Mapping mapping, int size) {
  switch (mapping) {
    case Mapping::equirectangular:
    case Mapping::dual_paraboloid: return {mapping, 2 * size, size};
    case Mapping::cube: return {mapping, size, 6 * size};
    default: return {mapping, size, size};
  }
}

void check_map_shape(MapShape shape) {
  const auto [mapping, width, height] = shape;
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width < 1 || height < 1 || std::int64_t{width} * height > INT32_MAX) {
    throw Error("a map of " + size + " texels is out of range: at least 1 and at most 2^31 - 1 in all");
  }
  const std::string name(mapping_name(mapping));
  const bool square = mapping == Mapping::mirror_ball || mapping == Mapping::octahedral;
  if (square && width != height) throw Error("a " + name + " map must be square, not " + size);
  if (mapping == Mapping::dual_paraboloid && width != 2 * height) {
    throw Error("a " + name + " map must be twice as wide as high, not " + size);
  }
  if (mapping == Mapping::cube && height != 6 * width)
    throw Error("a cube must be N x 6N texels, not " + size);
}

MapPoint map_point(MapShape shape, Vec3 direction) {
  switch (shape.mapping) {
    case Mapping::equirectangular: {
      const Uv uv = equirect_uv(direction);
      return {uv.u * shape.width, uv.v * shape.height, 0};
    }
    case Mapping::cube: return cube_map_point(shape.width, direction);
    case Mapping::dual_paraboloid: return paraboloid_point(shape.height, normalized(direction));
    case Mapping::mirror_ball: {
      const Plane p = ball_plane(normalized(direction));
      return {(p.a + 1) / 2 * shape.width, (1 - p.b) / 2 * shape.height, 0};
    }
    default: return octahedral_point(shape.width, direction);
  }
}

Vec3 map_texel_direction(MapShape shape, int x, int y, double fx, double fy) {
  const int size = shape.height;
  switch (shape.mapping) {
    case Mapping::equirectangular:
      return equirect_direction({(x + fx) / shape.width, (y + fy) / shape.height});
    case Mapping::cube: {
      const int n = shape.width;
      return cube_direction({y / n, 2 * (x + fx) / n - 1, 2 * (y % n + fy) / n - 1});
    }
    case Mapping::dual_paraboloid: {
      const int half = x < size ? 0 : 1;
      return paraboloid_direction(plane_of(size, x - half * size, y, fx, fy), half == 0 ? 1 : -1);
    }
    case Mapping::mirror_ball: return ball_direction(plane_of(size, x, y, fx, fy));
    default: return octahedral_direction(2 * (x + fx) / size - 1, 2 * (y + fy) / size - 1);
  }
}

bool map_covers(MapShape shape, int x, int y, double fx, double fy) {
  if (shape.mapping != Mapping::dual_paraboloid && shape.mapping != Mapping::mirror_ball) return true;
  const Plane p = plane_of(shape.height, x % shape.height, y, fx, fy);
  return p.a * p.a + p.b * p.b <= 1;
}

double map_density(MapShape shape, Vec3 d) {
  const double texel = 2.0 / shape.height;
  switch (shape.mapping) {
    case Mapping::equirectangular:
      return 2 * std::numbers::pi * std::numbers::pi / shape.width / shape.height * std::hypot(d.x, d.z);
    case Mapping::cube: {
      const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      return 4.0 / shape.width / shape.width * largest * largest * largest;
    }
    case Mapping::dual_paraboloid: return texel * texel * (1 + std::abs(d.z)) * (1 + std::abs(d.z));
    case Mapping::mirror_ball: return 4 * texel * texel;
    default: {
      const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
      return texel * texel * sum * sum * sum;
    }
  }
}

SphereMap make_sphere_map(MapShape shape, int channels) {
  check_map_shape(shape);
  return {shape.mapping, Image(shape.width, shape.height, channels)};
}

SphereMap sphere_map_from_cube(Cube cube) {
  SphereMap map{Mapping::cube, {}};
  map.image.width = cube.size;
  map.image.height = 6 * cube.size;
  map.image.channels = cube.channels;
  map.image.pixels = std::move(cube.texels);
  return map;
}

Cube cube_from_sphere_map(SphereMap map) {
  assert(map.mapping == Mapping::cube && map.image.height == 6 * map.image.width);
  Cube cube;
  cube.size = map.image.width;
  cube.channels = map.image.channels;
  cube.texels = std::move(map.image.pixels);
  return cube;
}

}  // namespace welkin
