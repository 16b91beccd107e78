#pragma once
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sphere/mat3.h>

// Rotation of functions given by coefficients. The function turns with the matrix: what it had in direction d it has in
// direction R d afterwards,
//   rotate(f, R)(R d) = f(d),   rotate(rotate(f, A), B) = rotate(f, B A).
// Two methods that agree to rounding (tests hold them together): matrices by the recurrence of Ivanic & Ruedenberg
// 1996 (erratum 1998), and z-x-z-x-z turns without matrices (Kautz, Sloan & Snyder 2002, appendix).

namespace welkin {

/// The largest degree that rotations take.
inline constexpr int max_rotation_degree = 64;

/// Throws Error unless the matrix is finite, orthogonal to 1e-6 and proper (determinant +1, no mirror).
void check_rotation(const Mat3& rotation);

/// The nearest orthogonal matrix of one that check_rotation accepts, to rounding (two Newton-Schulz steps). Every function
/// below does this first, so a matrix of floats rotates as well as its rounding lets it.
Mat3 orthonormalized(const Mat3& rotation);

/// The matrices that rotate the coefficients of each degree: orthogonal, c'_lm = sum over n of M^l_mn c_ln.
struct ShRotation {
  int max_degree = -1;
  std::vector<double> blocks;  ///< block l, (2l+1) x (2l+1) row-major, follow each other

  /// The element of row m and column n of block l.
  double at(int l, int m, int n) const {
    return blocks[static_cast<std::size_t>(l * (4 * l * l - 1) / 3 + (m + l) * (2 * l + 1) + n + l)];
  }
};

/// By Ivanic & Ruedenberg 1996, O(max_degree^3); orthogonal to 2e-14 (to 2e-11 at degree 64 where the compiler has no
/// long double wider than double). Throws Error as check_rotation does, and when max_degree is not in
/// [0, max_rotation_degree].
ShRotation make_sh_rotation(const Mat3& rotation, int max_degree);

/// Multiplies by the matrices. Throws Error when the coefficients are malformed or exceed rotation.max_degree.
ShCoefficients rotate(const ShCoefficients& coefficients, const ShRotation& rotation);

/// Without matrices: R = Z(a) X(-90) Z(b) X(90) Z(c). Turns about z mix only the pairs (m, -m); the quarter turns about x
/// are constant, three quarters zeros, made once by the recurrence above. About half the work of multiplying by
/// matrices and none for building them: the method of choice. Throws as the others do.
ShCoefficients rotate(const ShCoefficients& coefficients, const Mat3& rotation);

/// Cosines and sines of the angles of R = Z(a) Y(b) Z(c), straight from the entries (no trigonometric calls). Where the
/// axis of b is lost (b = 0 or 180 degrees) a is whatever its rounding makes it and c follows from it, so the
/// product is always R.
struct ZyzTurn {
  double cos_a = 1, sin_a = 0, cos_b = 1, sin_b = 0, cos_c = 1, sin_c = 0;
};

/// Of an orthogonal matrix (not checked, not repaired).
ZyzTurn zyz_turn(const Mat3& rotation);

enum class MirrorAxis { x, y, z };

/// The mirrored function f(x, y, z) -> f(-x, y, z), or the same in y or z: changes of sign only, exact at any degree.
/// With rotate it makes every improper transformation. Throws Error when the coefficients are malformed.
ShCoefficients mirror(const ShCoefficients& coefficients, MirrorAxis axis);

}  // namespace welkin
