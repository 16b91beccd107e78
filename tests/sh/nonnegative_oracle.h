#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <welkin/sampling/quadrature.h>
#include <welkin/sh/basis.h>

// The nearest non-negative function of degree 2 by another road: a logarithmic barrier,
//   minimise |q(S) - f|^2 / 2 - mu ln det S over symmetric 4 x 4 matrices S,
// followed to mu = 1e-15 by Newton steps, the last in quadruple precision; q(S) comes of quadrature over the sphere. Slow, plain,
// and shares nothing with the library but the basis functions and Gauss-Legendre nodes.

namespace welkin::oracle {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Real = __float128;
#else
using Real = long double;  // quadruple where it matters: aarch64, s390x
#endif
using Nine = std::array<double, 9>;
template <class T, std::size_t R, std::size_t C>
using Matrix = std::array<std::array<T, C>, R>;
template <class T>
using Ten = std::array<T, 10>;

inline constexpr std::array<std::pair<int, int>, 10> entries{
    {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Row k: the nine coefficients of (n,1)^T E_k (n,1), E_k the k-th unit matrix (both entries off the diagonal).
inline const Matrix<double, 10, 9>& columns() {
  static const auto made = [] {
    Matrix<double, 10, 9> out{};
    const QuadratureRule rule = gauss_legendre(6);
    constexpr int azimuths = 10;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      for (int j = 0; j < azimuths; ++j) {
        const double z = rule.nodes[i], r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * j / azimuths;
        const std::array<double, 4> v{r * std::cos(phi), r * std::sin(phi), z, 1};
        std::array<double, 9> y;
        evaluate_sh_basis({v[0], v[1], v[2]}, 2, y);
        const double weight = rule.weights[i] * 2 * std::numbers::pi / azimuths;
        for (int k = 0; k < 10; ++k) {
          const auto [a, b] = entries[k];
          for (int c = 0; c < 9; ++c) out[k][c] += (a == b ? 1 : 2) * weight * v[a] * v[b] * y[c];
        }
      }
    }
    return out;
  }();
  return made;
}

/// a x = b for every column of b, a symmetric and positive definite, by elimination without exchange.
template <class T, std::size_t N, std::size_t C>
Matrix<T, N, C> solve(Matrix<T, N, N> a, Matrix<T, N, C> b) {
  for (std::size_t i = 0; i < N; ++i) {
    const T inverse = 1 / a[i][i];
    for (std::size_t r = i + 1; r < N; ++r) {
      const T factor = a[i][r] * inverse;
      for (std::size_t c = r; c < N; ++c) a[r][c] -= factor * a[i][c];
      for (std::size_t c = 0; c < C; ++c) b[r][c] -= factor * b[i][c];
    }
  }
  for (std::size_t i = N; i-- > 0;) {
    for (std::size_t c = 0; c < C; ++c) {
      for (std::size_t r = i + 1; r < N; ++r) b[i][c] -= a[i][r] * b[r][c];
      b[i][c] /= a[i][i];
    }
  }
  return b;
}

template <class T>
Matrix<T, 4, 4> matrix_of(const Ten<T>& s) {
  Matrix<T, 4, 4> m;
  for (int k = 0; k < 10; ++k)
    m[entries[k].first][entries[k].second] = m[entries[k].second][entries[k].first] = s[k];
  return m;
}

/// All pivots of an elimination without exchange are positive: exactly for positive definite matrices.
template <class T>
bool is_positive_definite(Matrix<T, 4, 4> m) {
  for (int i = 0; i < 4; ++i) {
    if (!(m[i][i] > 0)) return false;
    for (int r = i + 1; r < 4; ++r) {
      const T factor = m[r][i] / m[i][i];
      for (int c = i; c < 4; ++c) m[r][c] -= factor * m[i][c];
    }
  }
  return true;
}

/// The moment matrix X of p: <X, E_k> = p . columns[k].
inline Matrix<double, 4, 4> moment_matrix(const Nine& p) {
  Ten<double> x{};
  for (int k = 0; k < 10; ++k) {
    for (int c = 0; c < 9; ++c) x[k] += p[c] * columns()[k][c];
    if (k >= 4) x[k] /= 2;
  }
  return matrix_of(x);
}

/// Newton steps from s to the minimum for this mu.
template <class T>
void center(Ten<T>& s, const Nine& f, double mu) {
  Matrix<T, 4, 4> identity{};
  for (int i = 0; i < 4; ++i) identity[i][i] = 1;
  for (int step = 0; step < 40; ++step) {
    const Matrix<T, 4, 4> inverse = solve(matrix_of(s), identity);
    std::array<T, 9> p;
    for (int c = 0; c < 9; ++c) {
      p[c] = -f[c];
      for (int k = 0; k < 10; ++k) p[c] += s[k] * columns()[k][c];
    }
    Matrix<T, 10, 1> descent{};
    Matrix<T, 10, 10> hessian{};  // upper triangle
    static const Matrix<double, 10, 10> gram = [] {
      Matrix<double, 10, 10> out{};
      for (int k = 0; k < 10; ++k)
        for (int l = 0; l < 10; ++l)
          for (int c = 0; c < 9; ++c) out[k][l] += columns()[k][c] * columns()[l][c];
      return out;
    }();
    for (int k = 0; k < 10; ++k) {
      const auto [a, b] = entries[k];
      const int twice = a == b ? 1 : 2;
      for (int c = 0; c < 9; ++c) descent[k][0] -= p[c] * columns()[k][c];
      descent[k][0] += mu * twice * inverse[a][b];
      for (int l = k; l < 10; ++l) {
        const auto [d, e] = entries[l];
        const double factor = mu * twice * (d == e ? 0.5 : 1);
        hessian[k][l] = gram[k][l] + factor * (inverse[a][d] * inverse[b][e] + inverse[a][e] * inverse[b][d]);
      }
    }
    const Matrix<T, 10, 1> d = solve(hessian, descent);
    T decrement = 0;
    for (int k = 0; k < 10; ++k) decrement += d[k][0] * descent[k][0];
    const double relative = static_cast<double>(decrement / mu);
    double length = 1;
    Ten<T> next;
    do {
      for (int k = 0; k < 10; ++k) next[k] = s[k] + length * d[k][0];
      length *= 0.7;
    } while (!is_positive_definite(matrix_of(next)) && length > 1e-6);
    s = next;
    if (!(relative > 1e-8)) break;
  }
}

/// The nearest non-negative function; f is of the size of 1.
inline Nine nearest_nonnegative(const Nine& f) {
  Ten<double> start{10, 10, 10, 10};
  double mu = 10;
  for (; mu > 1e-5; mu *= 0.2) center(start, f, mu);
  Ten<long double> extended;
  for (int k = 0; k < 10; ++k) extended[k] = start[k];
  for (; mu > 1e-8; mu *= 0.1) center(extended, f, mu);
  Ten<Real> s;
  for (int k = 0; k < 10; ++k) s[k] = extended[k];
  for (; mu > 1e-15; mu *= 0.1) center(s, f, mu);
  Nine q;
  for (int c = 0; c < 9; ++c) {
    Real sum = 0;
    for (int k = 0; k < 10; ++k) sum += s[k] * columns()[k][c];
    q[c] = static_cast<double>(sum);
  }
  return q;
}

}  // namespace welkin::oracle
