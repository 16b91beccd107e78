#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/sphere/equirect.h>

#include "maps.h"

// What the tests of EnvironmentSampler share: all kinds of options, maps, positions.

namespace welkin {

constexpr double two_pi_squared = 2 * std::numbers::pi * std::numbers::pi;

inline std::vector<EnvironmentTable> all_tables() {
  return {EnvironmentTable::inverse, EnvironmentTable::alias, EnvironmentTable::hierarchical};
}

inline std::string name_of(const EnvironmentSamplerOptions& options) {
  const char* tables[] = {"inverse", "alias", "hierarchical"};
  return std::string(tables[static_cast<int>(options.table)]) +
         (options.density == EnvironmentDensity::luminance ? ", luminance" : ", luminance x solid angle") +
         (options.interpolation == EnvironmentInterpolation::box ? ", box" : ", bilinear");
}

inline std::vector<EnvironmentSamplerOptions> all_options() {
  std::vector<EnvironmentSamplerOptions> all;
  for (EnvironmentTable table : all_tables())
    for (auto density : {EnvironmentDensity::luminance_solid_angle, EnvironmentDensity::luminance})
      for (auto interpolation : {EnvironmentInterpolation::box, EnvironmentInterpolation::bilinear})
        all.push_back({density, table, interpolation});
  return all;
}

/// One lit texel, blue only.
inline Image one_texel_map(int width, int height, int x, int y) {
  Image map(width, height);
  map.at(x, y)[2] = 3;
  return map;
}

/// Noise with a third of its texels black, and a black row and column.
inline Image holey_map(int width, int height, unsigned seed) {
  Image map = noise_map(width, height, seed);
  std::mt19937 random(seed + 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (random() % 3 == 0 || y == height / 3 || x == width / 4) std::fill_n(map.at(x, y), 3, 0.0f);
  return map;
}

inline Vec3f float_direction(double s, double t) {
  const Vec3 d = equirect_direction({s, t});
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}
inline Uv uv_of(Vec3f d) { return equirect_uv({d.x, d.y, d.z}); }

/// Uniform in [0, 1) with 24 bits, as SampleStream's.
class UnitNumbers {
 public:
  explicit UnitNumbers(unsigned seed) : random_(seed) {}
  float one() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }
  Vec2f two() {
    const float x = one();
    return {x, one()};
  }

 private:
  std::mt19937 random_;
};

/// The integral of the sampler's pdf over each texel, by a rule that is exact for its density in (s, t): two Gauss nodes
/// each way in each quarter of a texel, where the interpolation has no kink.
inline std::vector<double> texel_integrals(const EnvironmentSampler& sampler, int width, int height) {
  std::vector<double> integrals(static_cast<std::size_t>(width) * height);
  const double node = 0.5 / std::sqrt(3.0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 16; ++k) {
        const double across = 0.25 + 0.5 * (k & 1) + (k & 2 ? node : -node) / 2;
        const double down = 0.25 + 0.5 * ((k >> 2) & 1) + (k & 8 ? node : -node) / 2;
        const double s = (x + across) / width, t = (y + down) / height;
        integrals[static_cast<std::size_t>(y) * width + x] +=
            sampler.pdf(float_direction(s, t)) * two_pi_squared * std::sin(std::numbers::pi * t) /
            (16.0 * width * height);
      }
  return integrals;
}

}  // namespace welkin
