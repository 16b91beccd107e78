#pragma once
#include <functional>
#include <span>
#include <vector>

namespace welkin {

/// A point that a search ended at, and the function there.
struct SimplexMinimum {
  std::vector<double> point;
  double value = 0;
};

/// A local minimum by the simplex method (Nelder & Mead 1965), with the coefficients of that paper, for a few variables
/// and functions without derivatives: starts from `start` and one corner a step away along each axis, stops after
/// `iterations`. `start` and `step` have the same size, no step is 0. Deterministic.
SimplexMinimum simplex_search(const std::function<double(std::span<const double>)>& function,
                              std::span<const double> start, std::span<const double> step, int iterations);

}  // namespace welkin
