#pragma once
#include <vector>

namespace welkin {

/// Nodes and weights of a quadrature rule: integral of f over the rule's interval = sum of weights[i] f(nodes[i]).
struct QuadratureRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};

/// The Gauss-Legendre rule with `count` >= 1 nodes on [-1, 1], nodes ascending: exact for polynomials up to degree
/// 2 count - 1. Accurate to a few ulps for any count up to several thousand (Newton iteration on P_count).
QuadratureRule gauss_legendre(int count);

/// The relative error that gauss_legendre(count) makes for cos(kappa s) over [-1, 1] (its leading term): how well
/// `count` nodes integrate an oscillation whose phase advances by 2 kappa over the interval.
double gauss_legendre_error(int count, double kappa);

}  // namespace welkin
