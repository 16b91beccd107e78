#include <welkin/sh/algebra.h>

#include <algorithm>
#include <string>

#include <welkin/error.h>

namespace welkin {
namespace {

void check_same_channels(const ShCoefficients& a, const ShCoefficients& b) {
  check_coefficients(a);
  check_coefficients(b);
  if (a.channels != b.channels)
    throw Error("coefficients with " + std::to_string(a.channels) + " and with " +
                std::to_string(b.channels) + " channels do not go together");
}

void check_same_shape(const ShCoefficients& a, const ShCoefficients& b) {
  check_same_channels(a, b);
  if (a.max_degree != b.max_degree)
    throw Error("coefficients of degree " + std::to_string(a.max_degree) + " and of degree " +
                std::to_string(b.max_degree) + " do not go together");
}

}  // namespace

void check_coefficients(const ShCoefficients& coefficients, std::string_view what) {
  const std::string name(what);
  if (coefficients.max_degree < 0 || coefficients.max_degree > max_basis_degree)
    throw Error(name + ": the degree must be between 0 and " + std::to_string(max_basis_degree) + ", not " +
                std::to_string(coefficients.max_degree));
  if (coefficients.channels < 1)
    throw Error(name + ": at least one channel is needed, not " + std::to_string(coefficients.channels));
  const std::size_t expected = sh_count(coefficients.max_degree) * coefficients.channels;
  if (coefficients.values.size() != expected)
    throw Error(name + ": degree " + std::to_string(coefficients.max_degree) + " with " +
                std::to_string(coefficients.channels) + " channels needs " + std::to_string(expected) +
                " values, not " + std::to_string(coefficients.values.size()));
}

ShCoefficients add(const ShCoefficients& a, const ShCoefficients& b) {
  check_same_shape(a, b);
  ShCoefficients sum = a;
  for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += b.values[i];
  return sum;
}

ShCoefficients scale(const ShCoefficients& a, double factor) {
  check_coefficients(a);
  ShCoefficients result = a;
  for (double& value : result.values) value *= factor;
  return result;
}

ShCoefficients scale(const ShCoefficients& a, std::span<const double> factors) {
  check_coefficients(a);
  if (static_cast<int>(factors.size()) != a.channels)
    throw Error("coefficients with " + std::to_string(a.channels) + " channels cannot be scaled by " +
                std::to_string(factors.size()) + " factors");
  ShCoefficients result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] *= factors[i % factors.size()];
  return result;
}

ShCoefficients blend(const ShCoefficients& a, const ShCoefficients& b, double t) {
  check_same_shape(a, b);
  ShCoefficients result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = (1 - t) * a.values[i] + t * b.values[i];
  return result;
}

ShCoefficients resize(const ShCoefficients& a, int max_degree) {
  check_coefficients(a);
  if (max_degree < 0 || max_degree > max_basis_degree)
    throw Error("the degree must be between 0 and " + std::to_string(max_basis_degree));
  ShCoefficients result(max_degree, a.channels);
  std::copy_n(a.values.begin(), std::min(a.values.size(), result.values.size()), result.values.begin());
  return result;
}

std::vector<double> inner_product(const ShCoefficients& a, const ShCoefficients& b) {
  check_same_channels(a, b);
  std::vector<double> sums(a.channels);
  const std::size_t common = std::min(a.values.size(), b.values.size());
  for (std::size_t i = 0; i < common; ++i) sums[i % sums.size()] += a.values[i] * b.values[i];
  return sums;
}

}  // namespace welkin
