#include <welkin/sh/hemispherical.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <welkin/error.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/algebra.h>
#include <welkin/sh/rotation.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;

void check_functions(int functions) {
  if (functions != 4 && functions != 6) throw Error("the H-basis has 4 or 6 functions");
}

}  // namespace

std::array<double, 6> h_basis(Vec3 d) {
  static const double constant = std::sqrt(1 / (2 * pi)), linear = std::sqrt(3 / (2 * pi)),
                      quadratic = std::sqrt(15 / (2 * pi));
  return {constant,     linear * d.y,          linear * (2 * d.z - 1),
          linear * d.x, quadratic * d.x * d.y, quadratic / 2 * (d.x * d.x - d.y * d.y)};
}

Mat3 tangent_frame(Vec3 normal) {
  const Vec3 aside = std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 bitangent = normalized(cross(normal, aside));
  return {{cross(bitangent, normal), bitangent, normal}};
}

// Products with the same order m are polynomials in z (sin^m theta squared), the others vanish over the azimuth. So
// max_degree/2 + 2 Gauss nodes on [0, 1] and max_degree + 3 azimuths are exact.
std::vector<double> hemispherical_matrix(int functions, int max_degree) {
  check_functions(functions);
  if (max_degree < 0 || max_degree > max_rotation_degree)
    throw Error("hemispheres take functions of degree 0 to " + std::to_string(max_rotation_degree));
  const QuadratureRule rule = gauss_legendre(max_degree / 2 + 2);
  const int azimuths = max_degree + 3;
  const std::size_t columns = sh_count(max_degree);
  std::vector<double> matrix(functions * columns), y(columns);
  for (std::size_t n = 0; n < rule.nodes.size(); ++n)
    for (int k = 0; k < azimuths; ++k) {
      const double z = (1 + rule.nodes[n]) / 2, r = std::sqrt(1 - z * z), phi = 2 * pi * k / azimuths;
      const Vec3 direction{r * std::cos(phi), r * std::sin(phi), z};
      const double weight = rule.weights[n] / 2 * 2 * pi / azimuths;
      const std::array<double, 6> h = h_basis(direction);
      evaluate_sh_basis(direction, max_degree, y);
      for (int i = 0; i < functions; ++i)
        for (std::size_t j = 0; j < columns; ++j) matrix[i * columns + j] += weight * h[i] * y[j];
    }
  return matrix;
}

HemisphericalCoefficients project_hemispherical(const ShCoefficients& function, const Mat3& frame,
                                                int functions) {
  const ShCoefficients local = rotate(function, frame);
  const std::vector<double> matrix = hemispherical_matrix(functions, function.max_degree);
  const std::size_t columns = sh_count(function.max_degree);
  const int channels = function.channels;
  HemisphericalCoefficients result{functions, channels, frame, {}};
  result.values.resize(static_cast<std::size_t>(functions) * channels);
  for (int i = 0; i < functions; ++i)
    for (std::size_t j = 0; j < columns; ++j)
      for (int c = 0; c < channels; ++c)
        result.values[i * channels + c] += matrix[i * columns + j] * local.values[j * channels + c];
  return result;
}

HemisphericalCoefficients project_hemispherical(const ShCoefficients& function, Vec3 normal, int functions) {
  return project_hemispherical(function, tangent_frame(normal), functions);
}

void evaluate(const HemisphericalCoefficients& coefficients, Vec3 direction, std::span<double> out) {
  assert(static_cast<int>(out.size()) == coefficients.channels);
  const std::array<double, 6> h = h_basis(coefficients.frame * direction);
  std::fill(out.begin(), out.end(), 0.0);
  for (int i = 0; i < coefficients.functions; ++i)
    for (int c = 0; c < coefficients.channels; ++c)
      out[c] += h[i] * coefficients.values[i * coefficients.channels + c];
}

}  // namespace welkin
