#include <welkin/sh/projection.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/transform.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

void check_degree(int max_degree) {
  if (max_degree < 0 || max_degree > max_projection_degree)
    throw Error("the degree must be between 0 and " + std::to_string(max_projection_degree));
}

void accumulate(ShCoefficients& sum, std::span<const double> basis, const double* value, double weight) {
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (int c = 0; c < sum.channels; ++c) sum.values[i * sum.channels + c] += weight * basis[i] * value[c];
}

void add(ShCoefficients& sum, const ShCoefficients& other) {
  for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += other.values[i];
}

// Integrates value(direction) * Y_lm over the rings of a product rule that is exact for the product of two functions
// of degree max_degree: Gauss-Legendre in z, equally spaced in azimuth.
template <class Value>
ShCoefficients project_band_limited(int max_degree, int channels, Value&& value) {
  const QuadratureRule rule = gauss_legendre(max_degree + 1);
  const int azimuths = 2 * max_degree + 2;
  auto partials = parallel_partials<ShCoefficients>(
      rule.nodes.size(), 1, [&](ShCoefficients& sum, std::size_t ring, std::size_t) {
        sum = ShCoefficients(max_degree, channels);
        std::vector<double> basis(sh_count(max_degree));
        const double z = rule.nodes[ring], r = std::sqrt(1 - z * z);
        for (int i = 0; i < azimuths; ++i) {
          const double phi = 2 * std::numbers::pi * i / azimuths;
          const Vec3 direction{r * std::cos(phi), r * std::sin(phi), z};
          const std::vector<double> values = value(direction);
          evaluate_sh_basis(direction, max_degree, basis);
          accumulate(sum, basis, values.data(), rule.weights[ring] * 2 * std::numbers::pi / azimuths);
        }
      });
  for (std::size_t i = 1; i < partials.size(); ++i) add(partials[0], partials[i]);
  return partials[0];
}

}  // namespace

// The fast transform gives the spectrum about the map's polar axis +Y. The function that it describes has the same
// degrees about any axis, so its coefficients about z follow by an exact quadrature of that function.
ShCoefficients project_equirect(const Image& radiance, int max_degree) {
  check_degree(max_degree);
  AnalysisOptions options;
  options.max_degree = max_degree;
  const Spectrum spectrum = analyze(radiance, options);
  return project_band_limited(max_degree, radiance.channels,
                              [&](Vec3 direction) { return evaluate(spectrum, direction); });
}

ShCoefficients project_equirect_texel_centres(const Image& radiance, int max_degree) {
  check_degree(max_degree);
  auto partials = parallel_partials<ShCoefficients>(
      radiance.height, 8, [&](ShCoefficients& sum, std::size_t begin, std::size_t end) {
        sum = ShCoefficients(max_degree, radiance.channels);
        std::vector<double> basis(sh_count(max_degree)), value(radiance.channels);
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
          const double solid_angle = equirect_texel_solid_angle(radiance.width, radiance.height, y);
          for (int x = 0; x < radiance.width; ++x) {
            evaluate_sh_basis(equirect_direction({(x + 0.5) / radiance.width, (y + 0.5) / radiance.height}),
                              max_degree, basis);
            std::copy_n(radiance.at(x, y), radiance.channels, value.begin());
            accumulate(sum, basis, value.data(), solid_angle);
          }
        }
      });
  for (std::size_t i = 1; i < partials.size(); ++i) add(partials[0], partials[i]);
  return partials[0];
}

void evaluate(const ShCoefficients& coefficients, Vec3 direction, std::span<double> out) {
  std::vector<double> basis(sh_count(coefficients.max_degree));
  evaluate_sh_basis(direction, coefficients.max_degree, basis);
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t i = 0; i < basis.size(); ++i)
    for (int c = 0; c < coefficients.channels; ++c)
      out[c] += basis[i] * coefficients.values[i * coefficients.channels + c];
}

}  // namespace welkin
