#pragma once
#include <span>
#include <vector>

namespace welkin {

/// sum over i of weights[i] P_l(cosines[i]) for l = 0 .. max_degree: the Legendre coefficients of a zonal function by
/// quadrature, when the weights hold function, solid angle and rule. By Bonnet's recurrence, stable for |x| <= 1.
std::vector<double> project_zonal(std::span<const double> cosines, std::span<const double> weights,
                                  int max_degree);

}  // namespace welkin
