#pragma once
#include <cmath>
#include <random>
#include <vector>

#include <tests/envmap/maps.h>
#include <tests/sh/random_coefficients.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/sphere/equirect.h>

// Queries with their true answers, and how far a method is from them.

namespace welkin {

struct TrueReflection {
  std::vector<ReflectionQuery> queries;
  std::vector<double> values;

  TrueReflection(const Image& radiance, const IsotropicBrdf& brdf, int count, unsigned seed)
      : queries(random_reflection_queries(count, seed)),
        values(reflect_brute_force(radiance, brdf, queries)) {}

  /// RMS of the error over RMS of the truth; `map` is anything that reflect() takes.
  template <class Map>
  double relative_error(const Map& map) const {
    double error = 0, signal = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto value = reflect(map, queries[i]);
      for (int c = 0; c < 3; ++c) {
        const double truth = values[i * 3 + c];
        error += (value[c] - truth) * (value[c] - truth);
        signal += truth * truth;
      }
    }
    return std::sqrt(error / signal);
  }
};

/// A map of random coefficients to a degree, the constant 4 added; texels are centre values.
inline Image random_smooth_map(int width, int degree, unsigned seed) {
  std::mt19937 random(seed);
  ShCoefficients f = random_coefficients(degree, 3, random);
  for (double& value : f.values) value /= degree + 1;
  for (int c = 0; c < 3; ++c) f.values[c] += 4 * std::sqrt(4 * std::numbers::pi);
  Image map(width, width / 2);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const auto value = value_in(f, equirect_direction({(x + 0.5) / map.width, (y + 0.5) / map.height}));
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = static_cast<float>(value[c]);
    }
  return map;
}

}  // namespace welkin
