#pragma once
#include <array>

#include <welkin/sh/minimum.h>
#include <welkin/sh/nonnegative.h>

// The projection onto the non-negative functions of degree 2: private to welkin/sh. See nonnegative.h.

namespace welkin::degree2 {

using Nine = std::array<double, 9>;
using Mat4 = std::array<std::array<double, 4>, 4>;  // symmetric

struct NearestNonnegative {
  Nine coefficients{};
  double multiplier = 0;  // t of the S-lemma, to rounding
  int iterations = 0;
  bool converged = true;
};

/// f is scaled so that its largest coefficient is about 1, and `minimum` is its minimum, below 0. The result may be
/// negative by some 1e-13.
NearestNonnegative project_nonnegative(const Nine& f, const QuadricMinimum& minimum);

/// Raises the constant until the function is proven non-negative; in nonnegative.cpp.
NonnegativeFit prove_by_lifting(const Nine& coefficients);

/// The coefficients of q(n) = (n, 1)^T S (n, 1); S + J gives the same ones.
Nine sh_from_matrix(const Mat4& s);

/// The adjoint of sh_from_matrix: <moments(p), S> = p . sh_from_matrix(S). For p = sum of w_i Y(n_i) it is the matrix
/// of moments, sum of w_i (n_i, 1)(n_i, 1)^T.
Mat4 moments(const Nine& p);

/// Y(n): the nine basis functions.
Nine basis9(double x, double y, double z);

/// True where the factorisation of `matrix` + shift I in floating point meets positive pivots only.
bool has_cholesky(const Mat4& matrix, double shift);

}  // namespace welkin::degree2
