#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sphere/mat3.h>

// Random sets, directions and rotations for the tests of the algebra of coefficients.

namespace welkin {

inline ShCoefficients random_coefficients(int max_degree, int channels, std::mt19937& random) {
  std::normal_distribution<double> normal;
  ShCoefficients result(max_degree, channels);
  for (double& value : result.values) value = normal(random);
  return result;
}

inline Vec3 random_unit_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

/// Uniform over all rotations: two random directions, made orthonormal, and their cross product.
inline Mat3 random_rotation(std::mt19937& random) {
  const Vec3 a = random_unit_vector(random), b = random_unit_vector(random);
  const Vec3 y = normalized(b - dot(a, b) * a);
  return {{a, y, cross(a, y)}};
}

inline Mat3 product(const Mat3& a, const Mat3& b) {
  const Mat3 columns = transposed(b);
  Mat3 result;
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = a.rows[i];
    result.rows[i] = {dot(row, columns.rows[0]), dot(row, columns.rows[1]), dot(row, columns.rows[2])};
  }
  return result;
}

inline std::vector<double> value_in(const ShCoefficients& f, Vec3 direction) {
  std::vector<double> value(f.channels);
  evaluate(f, direction, value);
  return value;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (!(std::abs(a[i] - b[i]) <= largest)) largest = std::abs(a[i] - b[i]);
  return largest;
}

}  // namespace welkin
