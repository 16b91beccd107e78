#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include <welkin/sphere/mat3.h>

// The recurrence of rotation matrices of real spherical harmonics: private to welkin/sh.
//
// Ivanic & Ruedenberg 1996 (J. Phys. Chem. 100, 6342; erratum 1998, J. Phys. Chem. A 102, 9099), equations 6-8 with the
// corrected table 2. With r the matrix of degree 1, the rotation matrix itself in the order (y, z, x) of m = -1, 0, 1,
//   M^l_mn = u U + v V + w W,   each a sum of terms  P(i; mu, n),  i = -1, 0, 1,  built from degree l - 1:
//   P(i; mu, n) = r_i0 M^(l-1)_(mu n)                                     |n| < l
//   P(i; mu, l) = r_i1 M^(l-1)_(mu l-1) - r_i-1 M^(l-1)_(mu -l+1)
//   P(i; mu,-l) = r_i1 M^(l-1)_(mu -l+1) + r_i-1 M^(l-1)_(mu l-1).
// u, v and w share the denominator sqrt((l+n)(l-n)), at |n| = l sqrt(2l(2l-1)); their numerators depend on m alone. So a
// row is a sum of at most five rows of the degree before it, times a row of reciprocals: loops that vectorise.
//
// Everything is constexpr, so that the small rotations can have their constant matrices as compile-time numbers.

namespace welkin::rotation {

/// std::sqrt that also runs at compile time; x >= 0.
template <class Real>
constexpr Real square_root(Real x) {
  if (!std::is_constant_evaluated()) return std::sqrt(x);
  if (x == 0) return 0;
  Real root = x > 1 ? x : 1;  // Newton from above falls until it reaches the rounded root
  for (;;) {
    const Real next = (root + x / root) / 2;
    if (next >= root) return root;
    root = next;
  }
}

/// The matrix of degree 1, row-major in the order m = -1, 0, 1.
template <class Real>
constexpr std::array<Real, 9> degree_one(const Mat3& r) {
  const auto& [x, y, z] = r.rows;
  return {y.y, y.z, y.x, z.y, z.z, z.x, x.y, x.z, x.x};
}

/// One term of a row: factor * P(i; mu, .).
template <class Real>
struct RowTerm {
  int i = 0, mu = 0;
  Real factor = 0;
};

/// The terms of row m of degree l >= 2; those with factor 0 name no row that does not exist.
template <class Real>
constexpr std::array<RowTerm<Real>, 5> row_terms(int l, int m) {
  const int a = m < 0 ? -m : m;
  const Real u = square_root(static_cast<Real>(l + a) * (l - a));
  const Real v = Real(0.5) * square_root(static_cast<Real>(l + a - 1) * (l + a));
  const Real w = a >= l - 1 ? Real(0) : Real(-0.5) * square_root(static_cast<Real>(l - a - 1) * (l - a));
  const Real root2 = square_root(Real(2));
  std::array<RowTerm<Real>, 5> terms{};
  if (a < l) terms[0] = {0, m, u};
  if (m == 0) {
    terms[1] = {1, 1, -root2 * v};
    terms[2] = {-1, -1, -root2 * v};
    return terms;
  }
  if (m > 0) {
    terms[1] = {1, m - 1, m == 1 ? root2 * v : v};
    if (m > 1) terms[2] = {-1, -m + 1, -v};
    if (w != 0) terms[3] = {1, m + 1, w}, terms[4] = {-1, -m - 1, w};
  } else {
    if (m < -1) terms[1] = {1, m + 1, v};
    terms[2] = {-1, -m - 1, m == -1 ? root2 * v : v};
    if (w != 0) terms[3] = {1, m - 1, w}, terms[4] = {-1, -m + 1, -w};
  }
  return terms;
}

/// row[n + l] += factor P(i; mu, n), all n; `before` is row mu of degree l - 1, ri the row (r_i-1, r_i0, r_i1).
template <class Real>
constexpr void add_term(int l, Real factor, const Real* ri, const Real* before, Real* row) {
  const Real inner = factor * ri[1], last = before[2 * l - 2], first = before[0];
  row[0] += factor * (ri[2] * first + ri[0] * last);
  for (int k = 0; k < 2 * l - 1; ++k) row[k + 1] += inner * before[k];
  row[2 * l] += factor * (ri[2] * last - ri[0] * first);
}

/// Block l >= 2, (2l+1) x (2l+1) row-major, from block l - 1. reciprocals has room for 2l + 1 numbers.
template <class Real>
constexpr void next_block(int l, const std::array<Real, 9>& r, const Real* before, Real* block,
                          Real* reciprocals) {
  const int size = 2 * l + 1, size_before = size - 2;
  for (int n = -l; n <= l; ++n) {
    const Real square = (n == l || n == -l) ? 2.0 * l * (2.0 * l - 1) : static_cast<Real>(l + n) * (l - n);
    reciprocals[n + l] = 1 / square_root(square);
  }
  for (int m = -l; m <= l; ++m) {
    Real* row = block + (m + l) * size;
    for (int k = 0; k < size; ++k) row[k] = 0;
    for (const RowTerm<Real>& term : row_terms<Real>(l, m))
      if (term.factor != 0)
        add_term(l, term.factor, r.data() + 3 * (term.i + 1), before + (term.mu + l - 1) * size_before, row);
    for (int k = 0; k < size; ++k) row[k] *= reciprocals[k];
  }
}

/// Where block l begins when the blocks 0, 1, 2, ... follow each other: the sum of (2k+1)^2, k < l.
constexpr int block_start(int l) { return l * (4 * l * l - 1) / 3; }

/// All blocks to max_degree, one after the other, to blocks[block_start(max_degree + 1)].
/// reciprocals has room for 2 max_degree + 1 numbers.
template <class Real>
constexpr void all_blocks(const Mat3& rotation, int max_degree, Real* blocks, Real* reciprocals) {
  const std::array<Real, 9> r = degree_one<Real>(rotation);
  blocks[0] = 1;
  if (max_degree >= 1)
    for (int k = 0; k < 9; ++k) blocks[1 + k] = r[k];
  for (int l = 2; l <= max_degree; ++l)
    next_block(l, r, blocks + block_start(l - 1), blocks + block_start(l), reciprocals);
}

/// The right-handed quarter turn about x: y goes to z, z to -y.
inline constexpr Mat3 quarter_turn_x{{Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}}};

/// Its matrix is three quarters zeros. With X a mirror symmetry in x is kept and one in y becomes one in z, so
/// (a, b) differs from 0 only if b has the x parity of a and the y parity that a has in z: b is a cosine (m >= 0) if
/// l + m_a is even, else a sine (m < 0), and its |m| has one parity. So the columns of a row lie 2 apart:
/// first, first + 2, ..., `count` of them (indices m + l).
struct Columns {
  int first = 0, count = 0;
};
constexpr Columns quarter_turn_columns(int l, int m) {
  const bool a_is_sine = m < 0, odd_m = m % 2 != 0, b_is_sine = (l + m) % 2 != 0;
  const bool x_odd = odd_m != a_is_sine;
  const bool b_odd_m = x_odd != b_is_sine;
  if (b_is_sine) {
    const int last = b_odd_m ? 1 : 2, count = l < last ? 0 : (l - last) / 2 + 1;  // |m| = last, last + 2, ...
    return {l - last - 2 * (count - 1), count};
  }
  const int first = b_odd_m ? 1 : 0;
  return {l + first, l < first ? 0 : (l - first) / 2 + 1};
}

/// The sign that a half turn about x gives Y_lm (y and z change sign).
constexpr double half_turn_x_sign(int l, int m) { return ((l + m) % 2 != 0) != (m < 0) ? -1 : 1; }

}  // namespace welkin::rotation
