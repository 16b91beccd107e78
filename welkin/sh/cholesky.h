#pragma once
#include <array>
#include <cmath>

// A small dense Cholesky solver: private to welkin/sh.

namespace welkin::degree2 {

/// Solves (h + shift I) x = rhs, h symmetric of which the lower triangle is read; false where a pivot is not positive.
template <int N>
bool solve_cholesky(const std::array<std::array<double, N>, N>& h, double shift,
                    const std::array<double, N>& rhs, std::array<double, N>& x) {
  std::array<std::array<double, N>, N> l;
  std::array<double, N> inverse;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = h[i][j] + (i == j ? shift : 0);
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j) {
        if (!(sum > 0)) return false;
        inverse[i] = 1 / std::sqrt(sum);
      } else {
        l[i][j] = sum * inverse[j];
      }
    }
  }
  for (int i = 0; i < N; ++i) {
    double sum = rhs[i];
    for (int k = 0; k < i; ++k) sum -= l[i][k] * x[k];
    x[i] = sum * inverse[i];
  }
  for (int i = N - 1; i >= 0; --i) {
    double sum = x[i];
    for (int k = i + 1; k < N; ++k) sum -= l[k][i] * x[k];
    x[i] = sum * inverse[i];
  }
  return true;
}

}  // namespace welkin::degree2
