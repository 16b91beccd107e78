#include <welkin/sh/quantity.h>

#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/sh/convolution.h>

namespace welkin {
namespace {

// What degree l of the radiance is multiplied by to give the quantity.
std::vector<double> degree_factors(int max_degree, ShQuantity quantity) {
  if (quantity == ShQuantity::radiance) return std::vector<double>(max_degree + 1, 1.0);
  std::vector<double> factors = cosine_lobe(max_degree);
  if (quantity == ShQuantity::irradiance_over_pi)
    for (double& factor : factors) factor /= std::numbers::pi;
  return factors;
}

}  // namespace

std::string_view sh_quantity_name(ShQuantity quantity) {
  switch (quantity) {
    case ShQuantity::irradiance: return "irradiance";
    case ShQuantity::irradiance_over_pi: return "irradiance-over-pi";
    default: return "radiance";
  }
}

ShQuantity parse_sh_quantity(std::string_view name) {
  for (ShQuantity quantity : {ShQuantity::radiance, ShQuantity::irradiance, ShQuantity::irradiance_over_pi})
    if (name == sh_quantity_name(quantity)) return quantity;
  throw Error("unknown quantity '" + std::string(name) +
              "'; choose radiance, irradiance or irradiance-over-pi");
}

ShCoefficients sh_of_quantity(const ShCoefficients& radiance, ShQuantity quantity) {
  if (quantity == ShQuantity::radiance) return radiance;
  return convolve(radiance, degree_factors(radiance.max_degree, quantity));
}

ShCoefficients sh_radiance_from(const ShCoefficients& coefficients, ShQuantity quantity) {
  if (quantity == ShQuantity::radiance) return coefficients;
  if (coefficients.max_degree > 2)
    throw Error("radiance does not follow from " + std::string(sh_quantity_name(quantity)) +
                " beyond degree 2, which has nothing of degree 3");
  std::vector<double> factors = degree_factors(coefficients.max_degree, quantity);
  for (double& factor : factors) factor = 1 / factor;
  return convolve(coefficients, factors);
}

}  // namespace welkin
