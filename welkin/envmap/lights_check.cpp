#include <welkin/envmap/lights_check.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/convolution.h>
#include <welkin/sh/projection.h>
#include <welkin/sphere/equirect.h>
#include <welkin/sphere/sphere_points.h>

namespace welkin {
namespace {

double luminance(const std::array<double, 3>& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

// A texel that the extraction changed: direction times solid angle times the luminance that it lost.
std::vector<Vec3> taken_light(const Image& map, const Image& residual) {
  std::vector<Vec3> taken;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      std::array<double, 3> lost{};
      for (int c = 0; c < 3; ++c) lost[c] = static_cast<double>(map.at(x, y)[c] - residual.at(x, y)[c]);
      if (luminance(lost) != 0)
        taken.push_back(luminance(lost) * equirect_texel_moment(map.width, map.height, x, y));
    }
  return taken;
}

std::vector<Vec3> normals_for(const std::vector<DirectionalLight>& lights, int count) {
  std::vector<Vec3> normals = sphere_points(count);
  constexpr int ring = 64;
  for (const DirectionalLight& light : lights) {
    const Vec3 d = light.direction;
    const Vec3 side = normalized(cross(d, std::abs(d.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0})),
               up = cross(d, side);
    for (int i = 0; i < ring; ++i) {
      const double phi = 2 * std::numbers::pi * i / ring, tilt = light.angular_radius * (i % 5 - 2) / 2;
      normals.push_back(normalized(std::cos(phi) * side + std::sin(phi) * up + std::tan(tilt) * d));
    }
  }
  return normals;
}

double largest_irradiance(const Image& map, const std::vector<Vec3>& normals) {
  const ShCoefficients irradiance = convolve(project_equirect(map, 20), cosine_lobe(20));
  double largest = 0;
  for (Vec3 n : normals) {
    std::array<double, 3> e{};
    evaluate(irradiance, n, e);
    largest = std::max(largest, luminance(e));
  }
  return largest;
}

}  // namespace

RecombinationErrors check_recombination(const Image& map, const ExtractedLights& extracted, int normals) {
  assert(map.pixels.size() == extracted.residual.pixels.size());
  const std::vector<Vec3> taken = taken_light(map, extracted.residual);
  const std::vector<Vec3> directions = normals_for(extracted.lights, normals);
  std::vector<std::array<double, 2>> differences(directions.size());
  parallel_for(directions.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double lost = 0, directional = 0, disc = 0;
      for (Vec3 t : taken) lost += std::max(0.0, dot(t, directions[i]));
      for (const DirectionalLight& light : extracted.lights) {
        directional += luminance(directional_irradiance(light, directions[i]));
        disc += luminance(disc_irradiance(light, directions[i]));
      }
      differences[i] = {directional - lost, disc - lost};
    }
  });
  RecombinationErrors errors;
  errors.largest_irradiance = largest_irradiance(map, directions);
  const double scale = errors.largest_irradiance > 0 ? 1 / errors.largest_irradiance : 0;
  const double share = 1 / static_cast<double>(std::max<std::size_t>(directions.size(), 1));
  for (const auto& d : differences) {
    errors.directional_max = std::max(errors.directional_max, std::abs(d[0]) * scale);
    errors.disc_max = std::max(errors.disc_max, std::abs(d[1]) * scale);
    errors.directional_rms += d[0] * d[0] * scale * scale * share;
    errors.disc_rms += d[1] * d[1] * scale * scale * share;
  }
  errors.directional_rms = std::sqrt(errors.directional_rms);
  errors.disc_rms = std::sqrt(errors.disc_rms);
  return errors;
}

}  // namespace welkin
