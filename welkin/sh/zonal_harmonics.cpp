#include <welkin/sh/zonal_harmonics.h>

#include <cmath>
#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

void check_degree(int max_degree) {
  if (max_degree < 0 || max_degree > max_basis_degree)
    throw Error("the degree must be between 0 and " + std::to_string(max_basis_degree));
}

// Y_l0 at the pole.
double pole_value(int l) { return std::sqrt((2 * l + 1) / (4 * pi)); }

}  // namespace

std::vector<double> convolution_factors(std::span<const double> zonal) {
  std::vector<double> factors(zonal.begin(), zonal.end());
  for (std::size_t l = 0; l < factors.size(); ++l) factors[l] /= pole_value(static_cast<int>(l));
  return factors;
}

std::vector<double> zonal_coefficients(std::span<const double> factors) {
  std::vector<double> zonal(factors.begin(), factors.end());
  for (std::size_t l = 0; l < zonal.size(); ++l) zonal[l] *= pole_value(static_cast<int>(l));
  return zonal;
}

ShCoefficients turn_zonal(std::span<const double> zonal, Vec3 axis) {
  const int max_degree = static_cast<int>(zonal.size()) - 1;
  check_degree(max_degree);
  ShCoefficients result(max_degree, 1);
  evaluate_sh_basis(axis, max_degree, result.values);
  for (int l = 0; l <= max_degree; ++l)
    for (int m = -l; m <= l; ++m) result.values[sh_index(l, m)] *= zonal[l] / pole_value(l);
  return result;
}

double evaluate_zonal(std::span<const double> zonal, double cos_theta) {
  double sum = 0, before = 0, legendre = 1;
  for (std::size_t l = 0; l < zonal.size(); ++l) {
    const double n = static_cast<double>(l);
    sum += zonal[l] * pole_value(static_cast<int>(l)) * legendre;
    const double next = ((2 * n + 1) * cos_theta * legendre - n * before) / (n + 1);
    before = legendre;
    legendre = next;
  }
  return sum;
}

std::vector<double> zonal_delta(int max_degree) {
  check_degree(max_degree);
  std::vector<double> zonal(max_degree + 1);
  for (int l = 0; l <= max_degree; ++l) zonal[l] = pole_value(l);
  return zonal;
}

// z_l = 2 pi Y_l0(pole) * integral of P_l from c = cos radius to 1. By Legendre's equation the integral is
// (1 - c^2) P_l'(c)/(l(l+1)), and P'_(l+1) = P'_(l-1) + (2l+1) P_l adds terms of one sign where the cap is small: no
// digits cancel, as they do in (P_(l-1) - P_(l+1))/(2l+1).
std::vector<double> zonal_cap(double radius, int max_degree) {
  check_degree(max_degree);
  if (!(radius >= 0 && radius <= pi)) throw Error("the radius of a cap must be between 0 and pi");
  const double c = std::cos(radius), s = std::sin(radius), half = std::sin(radius / 2);
  std::vector<double> zonal(max_degree + 1);
  zonal[0] = 2 * pi * pole_value(0) * 2 * half * half;
  double before = 1, legendre = c, slope_before = 0, slope = 1;  // P_(l-1), P_l, P'_(l-1), P'_l at l = 1
  for (int l = 1; l <= max_degree; ++l) {
    zonal[l] = 2 * pi * pole_value(l) * s * s * slope / (static_cast<double>(l) * (l + 1));
    const double next = ((2 * l + 1) * c * legendre - l * before) / (l + 1);
    const double next_slope = slope_before + (2 * l + 1) * legendre;
    before = legendre, legendre = next;
    slope_before = slope, slope = next_slope;
  }
  return zonal;
}

std::vector<double> zonal_clamped_cosine(int max_degree) {
  check_degree(max_degree);
  return zonal_coefficients(cosine_lobe(max_degree));
}

}  // namespace welkin
