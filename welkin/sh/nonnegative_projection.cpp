#include <welkin/sh/nonnegative_projection.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/sh/cholesky.h>
#include <welkin/sh/degree2_constants.h>
#include <welkin/sh/minimum.h>

// Derivation. Minimise |q(S) - f|^2 / 2 over all positive semidefinite 4 x 4 matrices S, q(S)(n) = (n,1)^T S (n,1):
// every q >= 0 has such an S by the S-lemma. With p = q - f and X = moments(p), the gradient with respect to S, the
// optimum is marked by S >= 0, X >= 0, S X = 0 (a convex problem: the conditions suffice). Ranks add up to 4 at most:
//   X = 0            f is non-negative itself
//   X = w v v^T      one zero of q, at n: q = f + w Y(n). Since |Y(n)| is the same everywhere, q(n) = 0 and grad q(n)
//                    = 0 say w = -f(n)/|Y|^2 and grad f(n) = 0: n is the minimum of f. A closed form.
//   S of rank 2, 1   two zeros; a circle of zeros, where the plane of the null space cuts the sphere.
//   S = 0            f is minus a moment sequence: X = moments(-f) >= 0.
// For the rest S = R R^T with as few columns as serve, by Newton's method in R: the low-rank staircase (Burer &
// Monteiro 2003; Boumal 2015). A minimum in R has X R = 0. If X has a negative eigenvalue, its eigenvector is added as
// a column: that lowers the error, so the search goes on downhill; with four columns nothing else can stop it.

namespace welkin::degree2 {
namespace {

using Vec4 = std::array<double, 4>;

constexpr int max_steps = 80;
constexpr double tolerance = 1e-12;  // of the conditions; the scale of f is 1

Vec4 multiply(const Mat4& m, const Vec4& v) {
  Vec4 out;
  for (int i = 0; i < 4; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2] + m[i][3] * v[3];
  return out;
}

double dot9(const Nine& a, const Nine& b) {
  double sum = 0;
  for (int i = 0; i < 9; ++i) sum += a[i] * b[i];
  return sum;
}

void add_square(const Vec4& u, Mat4& s) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) s[i][j] += u[i] * u[j];
}

Nine square_of(const Vec4& u) {
  Mat4 s{};
  add_square(u, s);
  return sh_from_matrix(s);
}

// The integral over the sphere of q q' for the changes (n,1)^T (u e_i^T + e_i u^T) (n,1) and those of (v, j), all i and
// j: with q = n^T A n + 2 b.n + c the integral is 4 pi (c c' + 4/3 b.b' + 2/15 <A, A'>), and u = (a, d) gives c = 2
// a_i/3, b = d e_i, A = a e_i^T + e_i a^T - 2 a_i/3 I for i < 3 and c = 2 d, b = a, A = 0 for the last.
void inner_products(const Vec4& u, const Vec4& v, Mat4& out) {
  constexpr double four_pi = 4 * std::numbers::pi;
  const double across = u[0] * v[0] + u[1] * v[1] + u[2] * v[2], ends = u[3] * v[3];
  const double diagonal = four_pi * (4 / 3.0 * ends + 4 / 15.0 * across);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      out[i][j] = four_pi * (4 / 9.0 - 8 / 45.0) * u[i] * v[j] + four_pi * (4 / 15.0) * u[j] * v[i];
    out[i][i] += diagonal;
    out[i][3] = four_pi * (4 / 3.0) * (u[i] * v[3] + u[3] * v[i]);
    out[3][i] = out[i][3];
  }
  out[3][3] = four_pi * (4 * ends + 4 / 3.0 * across);
}

// S = sum of the squares of K columns, and what belongs to it.
template <int K>
struct Factor {
  std::array<Vec4, K> columns{};
  Nine q, p;  // p = q - f
  double multiplier, error;

  Factor(const std::array<Vec4, K>& r, const Nine& f) : columns(r) {
    Mat4 s{};
    for (const Vec4& u : columns) add_square(u, s);
    q = sh_from_matrix(s);
    multiplier = (s[0][0] + s[1][1] + s[2][2]) / 3;  // the rest of S has no trace there
    for (int i = 0; i < 9; ++i) p[i] = q[i] - f[i];
    error = 0.5 * dot9(p, p);
  }
};

template <int N>
double norm2(const std::array<double, N>& v) {
  double sum = 0;
  for (double x : v) sum += x * x;
  return sum;
}

template <int K>
using Square = std::array<std::array<double, 4 * K>, 4 * K>;

// The second derivatives of the error in R: of q, and 2 X for each column; lower triangle.
template <int K>
Square<K> hessian(const Factor<K>& factor, const Mat4& x) {
  Square<K> h;
  for (int k = 0; k < K; ++k) {
    for (int l = 0; l <= k; ++l) {
      Mat4 block;
      inner_products(factor.columns[k], factor.columns[l], block);
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) h[4 * k + i][4 * l + j] = block[i][j] + (k == l ? 2 * x[i][j] : 0);
    }
  }
  // R Q gives the same S for every rotation Q: the error is flat along those directions, and a term that acts along
  // them only keeps rounding from walking there.
  for (int k = 0; k < K; ++k) {
    for (int l = 0; l < k; ++l) {
      std::array<double, 4 * K> turn{};
      for (int i = 0; i < 4; ++i) {
        turn[4 * k + i] = factor.columns[l][i];
        turn[4 * l + i] = -factor.columns[k][i];
      }
      for (int a = 4 * l; a < 4 * K; ++a)
        for (int b = 0; b <= a; ++b) h[a][b] += turn[a] * turn[b];
    }
  }
  return h;
}

enum class Step { taken, last, none };

// One Newton step, damped until the Hessian is positive and the error falls.
template <int K>
Step newton_step(Factor<K>& factor, const Nine& f) {
  const Mat4 x = moments(factor.p);
  const Square<K> h = hessian(factor, x);
  std::array<double, 4 * K> descent, step{};
  double trace = 0, size2 = 0;
  for (int k = 0; k < K; ++k) {
    const Vec4 xu = multiply(x, factor.columns[k]);
    for (int i = 0; i < 4; ++i) {
      descent[4 * k + i] = -2 * xu[i];
      trace += std::abs(h[4 * k + i][4 * k + i]);
      size2 += factor.columns[k][i] * factor.columns[k][i];
    }
  }
  double damping = 1e-14 * trace;
  for (int attempt = 0; attempt < 12; ++attempt) {
    if (solve_cholesky<4 * K>(h, damping, descent, step)) {
      std::array<Vec4, K> columns = factor.columns;
      for (int a = 0; a < 4 * K; ++a) columns[a / 4][a % 4] += step[a];
      const Factor<K> next(columns, f);
      const double length2 = norm2<4 * K>(step);
      // After a step this short the next would be 1e-20 long. Rounding hides long before whether the error falls,
      // so undamped steps are taken on trust once it can rise by no more than that.
      const bool last = attempt == 0 && length2 <= std::max(1e-20 * size2, 1e-18);
      const double slack = attempt == 0 ? 1e-14 * (1 + factor.error) : 0;
      if (last || next.error < factor.error + slack) {
        factor = next;
        return last ? Step::last : Step::taken;
      }
    }
    damping = attempt == 0 ? 1e-3 * trace : 5 * damping;
  }
  return Step::none;
}

// The least eigenvalue and its vector, by cyclic Jacobi rotations.
double least_eigenvalue(Mat4 m, Vec4& vector) {
  Mat4 v{};
  for (int i = 0; i < 4; ++i) v[i][i] = 1;  // rows are the vectors
  bool rotated = true;
  for (int sweep = 0; sweep < 12 && rotated; ++sweep) {
    rotated = false;
    for (int p = 0; p < 3; ++p) {
      for (int q = p + 1; q < 4; ++q) {
        if (std::abs(m[p][q]) < 1e-16 * (1 + std::abs(m[p][p]) + std::abs(m[q][q]))) continue;
        rotated = true;
        const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (int k = 0; k < 4; ++k) {
          const double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b;
          m[k][q] = s * a + c * b;
        }
        for (auto* rows : {&m, &v}) {
          for (int k = 0; k < 4; ++k) {
            const double a = (*rows)[p][k], b = (*rows)[q][k];
            (*rows)[p][k] = c * a - s * b;
            (*rows)[q][k] = s * a + c * b;
          }
        }
      }
    }
  }
  int least = 0;
  for (int i = 1; i < 4; ++i)
    if (m[i][i] < m[least][least]) least = i;
  vector = v[least];
  return m[least][least];
}

// Walks down from R with K columns, then climbs the staircase.
template <int K>
NearestNonnegative descend(const std::array<Vec4, K>& start, const Nine& f, int iterations) {
  Factor<K> factor(start, f);
  Step step = Step::taken;
  for (int i = 0; i < max_steps && step == Step::taken; ++i, ++iterations) step = newton_step(factor, f);
  const Mat4 x = moments(factor.p);
  if (has_cholesky(x, tolerance)) return {factor.q, factor.multiplier, iterations, true};
  Vec4 v;
  const double least = least_eigenvalue(x, v);
  if (least >= -tolerance) return {factor.q, factor.multiplier, iterations, true};
  if constexpr (K == 4) {
    return {factor.q, factor.multiplier, iterations, false};
  } else {
    // Along S + a^2 v v^T the error changes by a^2 least + a^4 |q(v v^T)|^2 / 2.
    const Nine square = square_of(v);
    const double a = std::sqrt(-least / dot9(square, square));
    std::array<Vec4, K + 1> columns{};
    std::copy(factor.columns.begin(), factor.columns.end(), columns.begin());
    for (int i = 0; i < 4; ++i) columns[K][i] = a * v[i];
    return descend<K + 1>(columns, f, iterations);
  }
}

// The matrix of f - min f is positive semidefinite with t = -multiplier: a start near the answer is its largest square.
Vec4 first_column(const Nine& f, const SphereQuadric& quadric, const QuadricMinimum& minimum) {
  const double t = -minimum.multiplier;
  const SphereQuadric& q = quadric;
  Mat4 m{Vec4{q.xx + t, q.xy, q.xz, q.b.x}, Vec4{q.xy, q.yy + t, q.yz, q.b.y},
         Vec4{q.xz, q.yz, q.zz + t, q.b.z}, Vec4{q.b.x, q.b.y, q.b.z, q.c - minimum.value - t}};
  for (int squaring = 0; squaring < 4; ++squaring) {
    const double trace = m[0][0] + m[1][1] + m[2][2] + m[3][3];
    if (!(trace > 0)) return {0, 0, 0, 1e-3};
    Mat4 next;
    for (int i = 0; i < 4; ++i) next[i] = multiply(m, m[i]);
    for (auto& row : next)
      for (double& entry : row) entry /= trace * trace;
    m = next;
  }
  int largest = 0;
  for (int i = 1; i < 4; ++i)
    if (m[i][i] > m[largest][largest]) largest = i;
  Vec4 u = m[largest];
  const Nine square = square_of(u);
  const double squares = dot9(square, square);
  if (!(squares > 0)) return {0, 0, 0, 1e-3};
  const double scale = std::sqrt(std::max(dot9(square, f) / squares, 1e-6));
  for (double& entry : u) entry *= scale;
  return u;
}

}  // namespace

Nine basis9(double x, double y, double z) {
  return {y00,
          y1 * y,
          y1 * z,
          y1 * x,
          y2 * x * y,
          y2 * y * z,
          y20 * (3 * z * z - 1),
          y2 * x * z,
          y22 * (x * x - y * y)};
}

Nine sh_from_matrix(const Mat4& s) {
  const double third = (s[0][0] + s[1][1] + s[2][2]) / 3;
  Nine f;
  sh_from_quadric({s[0][0] - third,
                   s[1][1] - third,
                   s[2][2] - third,
                   s[0][1],
                   s[1][2],
                   s[0][2],
                   {s[0][3], s[1][3], s[2][3]},
                   s[3][3] + third},
                  f);
  return f;
}

Mat4 moments(const Nine& p) {
  const double all = p[0] / y00, zz = p[6] / (6 * y20), xy = p[8] / (2 * y22);
  const double bx = p[3] / y1, by = p[1] / y1, bz = p[2] / y1;
  const double mxy = p[4] / y2, myz = p[5] / y2, mxz = p[7] / y2;
  return {Vec4{all / 3 - zz + xy, mxy, mxz, bx}, Vec4{mxy, all / 3 - zz - xy, myz, by},
          Vec4{mxz, myz, all / 3 + 2 * zz, bz}, Vec4{bx, by, bz, all}};
}

bool has_cholesky(const Mat4& m, double shift) {
  double l[4][4];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      double sum = m[i][j];
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = sum / l[j][j];
    }
    double pivot = m[i][i] + shift;
    for (int k = 0; k < i; ++k) pivot -= l[i][k] * l[i][k];
    if (!(pivot > 0)) return false;
    l[i][i] = std::sqrt(pivot);
  }
  return true;
}

NearestNonnegative project_nonnegative(const Nine& f, const QuadricMinimum& minimum) {
  Nine negated;
  for (int i = 0; i < 9; ++i) negated[i] = -f[i];
  if (has_cholesky(moments(negated), 0)) return {};
  const Nine y = basis9(minimum.where.x, minimum.where.y, minimum.where.z);
  const double weight = -minimum.value / dot9(y, y);
  Nine one_zero;
  for (int i = 0; i < 9; ++i) one_zero[i] = f[i] + weight * y[i];
  const QuadricMinimum left = minimize_on_sphere(quadric_from_sh(one_zero));
  if (left.value >= -1e-13) return {one_zero, -left.multiplier, 0, true};
  return descend<1>({first_column(f, quadric_from_sh(f), minimum)}, f, 0);
}

}  // namespace welkin::degree2
