#include <welkin/sh/nonnegative_zonal.h>

#include <algorithm>
#include <cmath>

#include <welkin/sh/cholesky.h>

// Derivation. In the frame (a, e, g) the matrix of the S-lemma with t = tau + zeta/3 falls into
//   [zeta + tau, 0, along; 0, tau, across; along, across, c - zeta/3 - tau]  and  tau,
// so q >= 0 exactly where some alpha = zeta + tau >= 0 and tau >= 0 leave c >= alpha/3 + 2 tau/3 + along^2/alpha +
// across^2/tau. On the edge of that, with alpha = r^2, along = r p, tau = s^2, across = s m,
//   c = r^2/3 + 2 s^2/3 + p^2 + m^2,   zeta = r^2 - s^2:   q = (r a.n + p)^2 + (s e.n + m)^2 + s^2 (g.n)^2.
// The nearest one is found by Newton's method in (r, p, s, m). Its squared distance is half the sum of weight_i times
// the squared differences of (c, along, across, zeta); the weights are the squared norms of 1, 2 a.n, 2 e.n and
// (a.n)^2 - 1/3 over 4 pi. With w = weight times difference (w_c, w_a, w_e, w_z), a stationary point is the optimum
// where both 2 x 2 gradients [w_c/3 + w_z, w_a/2; w_a/2, w_c] and [2 w_c/3 - w_z, w_e/2; w_e/2, w_c] are positive
// semidefinite, as for any semidefinite problem.

namespace welkin::degree2 {
namespace {

using Vec4 = std::array<double, 4>;
using Mat4 = std::array<Vec4, 4>;

constexpr Vec4 weights{1, 4 / 3.0, 4 / 3.0, 4 / 45.0};
constexpr double tolerance = 1e-11;

Vec4 quadric_at(const Vec4& v) {
  const auto [r, p, s, m] = v;
  return {r * r / 3 + 2 * s * s / 3 + p * p + m * m, r * p, s * m, r * r - s * s};
}

struct Point {
  Vec4 v, w;  // (r, p, s, m) and the weighted differences
  double error;

  Point(const Vec4& at, const Vec4& f) : v(at), error(0) {
    const Vec4 q = quadric_at(v);
    for (int i = 0; i < 4; ++i) {
      w[i] = weights[i] * (q[i] - f[i]);
      error += 0.5 * w[i] * (q[i] - f[i]);
    }
  }
};

// One damped Newton step; false at the end.
bool step(Point& point, const Vec4& f) {
  const auto [r, p, s, m] = point.v;
  const auto& w = point.w;
  const Mat4 j{Vec4{2 * r / 3, 2 * p, 4 * s / 3, 2 * m}, {p, r, 0, 0}, {0, 0, m, s}, {2 * r, 0, -2 * s, 0}};
  Mat4 h{};
  Vec4 descent{}, change{};
  for (int k = 0; k < 4; ++k) {
    for (int a = 0; a < 4; ++a) {
      descent[a] -= w[k] * j[k][a];
      for (int b = 0; b < 4; ++b) h[a][b] += weights[k] * j[k][a] * j[k][b];
    }
  }
  h[0][0] += 2 * w[0] / 3 + 2 * w[3];
  h[1][1] += 2 * w[0];
  h[2][2] += 4 * w[0] / 3 - 2 * w[3];
  h[3][3] += 2 * w[0];
  h[1][0] += w[1];
  h[3][2] += w[2];
  double damping = 1e-15;
  for (int attempt = 0; attempt < 14; ++attempt, damping = std::max(1e-3, 5 * damping)) {
    if (!solve_cholesky<4>(h, damping, descent, change)) continue;
    Vec4 next = point.v;
    double length2 = 0;
    for (int i = 0; i < 4; ++i) {
      next[i] += change[i];
      length2 += change[i] * change[i];
    }
    const Point candidate(next, f);
    const bool last = attempt == 0 && length2 < 1e-22;
    if (!last && candidate.error >= point.error + (attempt == 0 ? 1e-15 : 0)) continue;
    point = candidate;
    return !last;
  }
  return false;
}

Point descend(const Vec4& start, const Vec4& f) {
  Point point(start, f);
  for (int i = 0; i < 80 && step(point, f); ++i) {
  }
  return point;
}

// The smaller eigenvalue of [x, y; y, z] and its vector.
double least(double x, double y, double z, double& vx, double& vz) {
  const double eigenvalue = 0.5 * (x + z) - std::hypot(0.5 * (x - z), y);
  const double angle = 0.5 * std::atan2(2 * y, x - z);  // of the larger one
  vx = -std::sin(angle);
  vz = std::cos(angle);
  return eigenvalue;
}

// Where a stationary point is no optimum, one pair is replaced by a direction that leads down.
bool escape(const Point& point, Vec4& start) {
  const auto& w = point.w;
  double vx = 0, vz = 0;
  start = point.v;
  const double first = least(w[0] / 3 + w[3], 0.5 * w[1], w[0], vx, vz);
  double ux = 0, uz = 0;
  const double second = least(2 * w[0] / 3 - w[3], 0.5 * w[2], w[0], ux, uz);
  if (std::min(first, second) >= -tolerance) return false;
  const double size = std::sqrt(-std::min(first, second));
  if (first < second) {
    start[0] = size * vx;
    start[1] = size * vz;
  } else {
    start[2] = size * ux;
    start[3] = size * uz;
  }
  return true;
}

}  // namespace

ZonalQuadric project_nonnegative_zonal(const ZonalQuadric& f) {
  const Vec4 target{f.c, f.along, f.across, f.zeta};
  // From a point with both squares there: their sizes by zeta, their shifts by the linear part.
  const double r = std::sqrt(std::max(f.zeta, 0.0) + 0.1), s = std::sqrt(std::max(-f.zeta, 0.0) + 0.1);
  Vec4 start{r, std::clamp(f.along / r, -1.0, 1.0), s, std::clamp(f.across / s, -1.0, 1.0)};
  Point best = descend(start, target);
  Point now = best;
  for (int tries = 0; tries < 6 && escape(now, start); ++tries) {
    now = descend(start, target);
    if (now.error < best.error) best = now;
  }
  const Vec4 q = quadric_at(best.v);
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace welkin::degree2
