#include <welkin/sh/minimum.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin {
namespace {

struct Eigen3 {
  std::array<double, 3> values;  // ascending
  std::array<Vec3, 3> vectors;   // orthonormal to rounding
};

// One Jacobi rotation that zeroes the entry between p and q; r is the third index.
void rotate(double (&a)[3][3], Vec3 (&v)[3], int p, int q, int r) {
  const double off = a[p][q];
  if (off == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * off);
  const double t = std::abs(theta) > 1e150
                       ? 0.5 / theta
                       : std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  a[p][p] -= t * off;
  a[q][q] += t * off;
  a[p][q] = a[q][p] = 0;
  const double rp = a[r][p], rq = a[r][q];
  a[r][p] = a[p][r] = c * rp - s * rq;
  a[r][q] = a[q][r] = s * rp + c * rq;
  const Vec3 vp = v[p];
  v[p] = c * vp - s * v[q];
  v[q] = s * vp + c * v[q];
}

// Cyclic Jacobi: unconditionally stable, quadratically convergent, three to five sweeps.
Eigen3 decompose(const SphereQuadric& m) {
  double a[3][3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  Vec3 v[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int sweep = 0; sweep < 12; ++sweep) {
    const double off = std::abs(a[0][1]) + std::abs(a[0][2]) + std::abs(a[1][2]);
    const double on = std::abs(a[0][0]) + std::abs(a[1][1]) + std::abs(a[2][2]);
    if (off <= 1e-17 * on) break;
    rotate(a, v, 0, 1, 2);
    rotate(a, v, 0, 2, 1);
    rotate(a, v, 1, 2, 0);
  }
  int order[3] = {0, 1, 2};
  if (a[order[1]][order[1]] < a[order[0]][order[0]]) std::swap(order[0], order[1]);
  if (a[order[2]][order[2]] < a[order[1]][order[1]]) std::swap(order[1], order[2]);
  if (a[order[1]][order[1]] < a[order[0]][order[0]]) std::swap(order[0], order[1]);
  Eigen3 eigen;
  for (int i = 0; i < 3; ++i) {
    eigen.values[i] = a[order[i]][order[i]];
    eigen.vectors[i] = v[order[i]];
  }
  return eigen;
}

// The secular equation. With mu = lambda_1 - s, gaps d_i = lambda_i - lambda_1 >= 0 and beta = b in the eigenbasis, the
// minimum is x_i = -beta_i / (d_i + s) for the s >= 0 at which |x| = 1. h(s) = 1/|x(s)| - 1 is a power mean of exponent
// -2 of linear functions, so concave and increasing: Newton from a point left of the root climbs to it and never
// passes it. s_0 = max(|beta_i| - d_i) is such a point, since one |x_i| is 1 there (and no x_i is larger).
// Hard case: |x| < 1 already at s = 0, which needs beta_1 = 0; the rest of the length goes to the first eigenvector.
struct Secular {
  double s = 0;
  std::array<double, 3> x{};
};

Secular solve_secular(const std::array<double, 3>& beta, const std::array<double, 3>& gap) {
  Secular secular;
  for (int i = 0; i < 3; ++i) secular.s = std::max(secular.s, std::abs(beta[i]) - gap[i]);
  for (int iteration = 0; iteration < 100; ++iteration) {
    double norm2 = 0, slope = 0;
    for (int i = 0; i < 3; ++i) {
      const double divisor = gap[i] + secular.s;
      secular.x[i] = beta[i] == 0 ? 0 : -beta[i] / divisor;
      norm2 += secular.x[i] * secular.x[i];
      if (beta[i] != 0) slope += secular.x[i] * secular.x[i] / divisor;
    }
    if (norm2 <= 1) {
      if (secular.s == 0) secular.x[0] = std::sqrt(1 - norm2);
      break;
    }
    const double next = secular.s + norm2 * (std::sqrt(norm2) - 1) / slope;
    if (!(next > secular.s)) break;
    secular.s = next;
  }
  return secular;
}

double largest_entry(const SphereQuadric& q) {
  return std::max({std::abs(q.xx), std::abs(q.yy), std::abs(q.zz), std::abs(q.xy), std::abs(q.yz),
                   std::abs(q.xz), std::abs(q.b.x), std::abs(q.b.y), std::abs(q.b.z), std::abs(q.c)});
}

SphereQuadric scaled(const SphereQuadric& q, double s) {
  return {s * q.xx, s * q.yy, s * q.zz, s * q.xy, s * q.yz, s * q.xz, s * q.b, s * q.c};
}

QuadricMinimum minimize_scaled(const SphereQuadric& q) {
  const Eigen3 eigen = decompose(q);
  std::array<double, 3> beta, gap;
  for (int i = 0; i < 3; ++i) {
    beta[i] = dot(eigen.vectors[i], q.b);
    if (std::abs(beta[i]) < 1e-200) beta[i] = 0;  // its square would vanish in the middle of the equation
    gap[i] = eigen.values[i] - eigen.values[0];
  }
  const Secular secular = solve_secular(beta, gap);
  QuadricMinimum minimum;
  minimum.where = normalized(secular.x[0] * eigen.vectors[0] + secular.x[1] * eigen.vectors[1] +
                             secular.x[2] * eigen.vectors[2]);
  // The value is that of the function itself, so errors of the direction enter squared only.
  minimum.value = evaluate(q, minimum.where);
  minimum.multiplier = eigen.values[0] - secular.s;
  return minimum;
}

}  // namespace

QuadricMinimum minimize_on_sphere(const SphereQuadric& quadric) {
  const double largest = largest_entry(quadric);
  if (largest == 0 || (largest > 1e-100 && largest < 1e100)) return minimize_scaled(quadric);
  const int exponent =
      std::clamp(std::ilogb(largest), -1000, 1000);  // a power of two: exact, and 1/it is finite
  QuadricMinimum minimum = minimize_scaled(scaled(quadric, std::ldexp(1.0, -exponent)));
  minimum.value = std::ldexp(minimum.value, exponent);
  minimum.multiplier = std::ldexp(minimum.multiplier, exponent);
  return minimum;
}

double minimum_degree2(std::span<const double, 9> coefficients, Vec3* where) {
  const QuadricMinimum minimum = minimize_on_sphere(quadric_from_sh(coefficients));
  if (where) *where = minimum.where;
  return minimum.value;
}

double maximum_degree2(std::span<const double, 9> coefficients, Vec3* where) {
  std::array<double, 9> negated;
  for (int i = 0; i < 9; ++i) negated[i] = -coefficients[i];
  return -minimum_degree2(negated, where);
}

}  // namespace welkin
