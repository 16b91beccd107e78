#pragma once
#include <array>
#include <span>
#include <vector>

#include <welkin/sh/projection.h>

// Functions of degree 2 (nine coefficients a channel) that are nowhere negative on the sphere, and the nearest such
// function to one that is.
//
// A function of degree 2 is q(n) = (n, 1)^T M (n, 1) with M = [A b; b^T c] (quadric.h). By the S-lemma (Yakubovich
// 1971; Polik & Terlaky 2007, theorem 2.2) q >= 0 on |n| = 1 exactly where M + t J, J = diag(1, 1, 1, -1), is positive
// semidefinite for some number t: t is a proof. (The lemma for equalities needs that J takes both signs, as it does.)

namespace welkin {

/// How coefficients will be stored: what is promised here is promised of the rounded numbers.
enum class CoefficientRounding {
  none,       // doubles
  to_float,   // each one is a float
  to_digits9  // each one is the double next to a decimal number of nine significant digits (printf "%.8e")
};

struct NonnegativeFit {
  std::array<double, 9> coefficients{};
  /// t of the proof: proves_nonnegative(coefficients, multiplier) is true.
  double multiplier = 0;
  /// coefficients[0] less that of the nearest function: room for the proof, at most about 1e-12 of the largest
  /// coefficient, or what the requested rounding takes and needs (about 1e-7, 1e-8; it may round below 0).
  double lift = 0;
  /// False: the input, rounded as asked, is proven non-negative already, and is returned as it is.
  bool changed = false;
  /// Newton steps taken; 0 where a closed form served.
  int iterations = 0;
  /// False (never seen) where the optimality conditions were not met to rounding: the result is non-negative all the
  /// same, but may not be the nearest.
  bool converged = true;
};

/// The function of degree 2 that is >= 0 everywhere and nearest in L2 over the sphere to `coefficients`, which are
/// finite; the basis is orthonormal, so it is also the nearest to any function whose projection these are. Within
/// 1e-9 of the largest coefficient (plus the lift). Takes microseconds.
NonnegativeFit nonnegative_fit(std::span<const double, 9> coefficients,
                               CoefficientRounding rounding = CoefficientRounding::none);

/// The same for every channel alone, which is optimal for all together, for degrees 0, 1 and 2 (closed forms for 0 and
/// 1: a half line and a circular cone). `fits`, where given, receives one entry a channel; unused coefficients are 0.
/// Throws Error for a degree above 2 and for coefficients that are not finite, or beyond 1e38 where floats are wanted.
ShCoefficients nonnegative_fit(const ShCoefficients& coefficients,
                               CoefficientRounding rounding = CoefficientRounding::none,
                               std::vector<NonnegativeFit>* fits = nullptr);

/// True only where M + multiplier J is positive semidefinite in exact arithmetic, for the exact functions of basis.h:
/// a Cholesky factorisation with a bound on all rounding (Higham 2002, theorem 10.7; Rump 2006). So true proves that
/// the function is nowhere negative on the sphere; false says nothing.
bool proves_nonnegative(std::span<const double, 9> coefficients, double multiplier);

}  // namespace welkin
