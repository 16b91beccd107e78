#include <welkin/envmap/methods/quick_taps.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <welkin/error.h>
#include <welkin/parallel/target_clones.h>

// Taps are a measure on the sphere; both it and the kernel multiply a map's harmonics, and the mean squared error over
// white maps (a single bright texel is one) goes with the sum over l, m of |K_lm - T_lm|^2. With the addition
// theorem, a tap at angle theta_i with weight w_i and a Gaussian footprint g_l(s_i) = exp(-l (l + 1) s_i^2 / 2):
//   error = sum_l (2l + 1) (k_l^2 - 2 k_l sum_i w_i g_l(s_i) P_l(cos theta_i)
//                               + sum_ij w_i w_j g_l(s_i) g_l(s_j) P_l(cos angle_ij)),
// which counts what the few taps of a ring miss in azimuth as well. For rings of equal taps the angles between two
// rings of m and n taps are those of lcm(m, n) evenly spread differences of azimuth. Given angles and footprints the
// error is quadratic in the weights: they are solved for; a simplex search (Nelder & Mead 1965) finds the rest.
//
// Real footprints are not Gaussians of one size: texels stretch, levels are blended, splines have ends. All variances
// s^2 are taken to be off by one share `footprint_spread`, which adds the error of that,
// sum_l (2l + 1) sum_ij w_i w_j d_l(s_i) d_l(s_j) P_l(cos angle_ij), d_l(s) = footprint_spread l (l + 1) s^2 g_l(s) / 2,
// and keeps the fit from leaving everything to one wide tap.

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int max_rings = 5;
constexpr double footprint_spread = 0.15;

// The widest footprint (rad): levels of few texels see a lamp shift and stretch, by more than the model above says;
// with more taps to spread it may be narrower. Chosen on maps of noise, lamps and a sun.
double widest_footprint(int count) { return 0.45 / std::sqrt(std::sqrt(count)); }

struct Ring {
  int count = 1;
  double offset = 0;  // azimuth of its first tap, in units of the spacing
  double angle = 0, deviation = 0, weight = 0;
};

using Rings = std::vector<Ring>;

// What the fit aims at: 2l + 1 and k_l.
struct Goal {
  std::vector<double> counts, factors;
  double power = 0;  // sum of (2l + 1) k_l^2
  double least_deviation = 0, widest = 0;
};

Goal make_goal(const ZonalKernel& kernel, double least_deviation, double widest) {
  Goal goal;
  goal.widest = widest;
  goal.least_deviation = std::min(least_deviation, widest);
  const int limit = std::clamp(static_cast<int>(12 / angular_width(kernel)), 24, 768);
  goal.factors = legendre_coefficients(kernel, limit);
  while (goal.factors.size() > 16 && std::abs(goal.factors.back()) < 3e-3) goal.factors.pop_back();
  goal.factors.resize(2 *
                      goal.factors.size());  // zeros, where narrow footprints show that the kernel has none
  for (std::size_t l = 0; l < goal.factors.size(); ++l) {
    goal.counts.push_back(2.0 * static_cast<double>(l) + 1);
    goal.power += goal.counts[l] * goal.factors[l] * goal.factors[l];
  }
  return goal;
}

// One step of the recurrence l P_l = (2l - 1) x P_(l-1) - (l - 1) P_(l-2), for many x.
WELKIN_TARGET_CLONES void next_legendre(int l, const double* x, const double* last, double* before,
                                        int count) {
  const double a = (2.0 * l - 1) / l, b = (l - 1.0) / l;
  for (int i = 0; i < count; ++i) before[i] = a * x[i] * last[i] - b * before[i];
}

// The quadratic form of the error in the ring's weights: power - 2 b.w + w.A w.
struct Quadratic {
  int size = 0;
  std::array<std::array<double, max_rings>, max_rings> a{};
  std::array<double, max_rings> b{};
};

// Cosines of all angles between taps of two rings, each once.
void add_cosines(const Ring& r, const Ring& s, std::vector<double>& cosines) {
  const int steps = std::lcm(r.count, s.count);
  const double first = 2 * pi * (r.offset / r.count - s.offset / s.count);
  for (int k = 0; k < steps; ++k)
    cosines.push_back(std::cos(r.angle) * std::cos(s.angle) +
                      std::sin(r.angle) * std::sin(s.angle) * std::cos(first + 2 * pi * k / steps));
}

Quadratic error_form(const Goal& goal, const Rings& rings) {
  Quadratic form;
  form.size = static_cast<int>(rings.size());
  std::vector<double> cosines;
  std::vector<int> begins;
  for (const Ring& r : rings) cosines.push_back(std::cos(r.angle));
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      begins.push_back(static_cast<int>(cosines.size()));
      add_cosines(rings[i], rings[j], cosines);
    }
  begins.push_back(static_cast<int>(cosines.size()));
  std::vector<double> last(cosines.size(), 1.0), before(cosines.size(), 0.0);
  std::array<double, max_rings> footprint{}, off{};
  for (int l = 0; l < static_cast<int>(goal.factors.size()); ++l) {
    if (l > 0) {
      next_legendre(l, cosines.data(), last.data(), before.data(), static_cast<int>(cosines.size()));
      last.swap(before);
    }
    for (std::size_t i = 0; i < rings.size(); ++i) {
      const double spread = 0.5 * l * (l + 1) * rings[i].deviation * rings[i].deviation;
      footprint[i] = std::exp(-spread);
      off[i] = footprint_spread * spread * footprint[i];
    }
    std::size_t pair = 0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
      form.b[i] += goal.counts[l] * goal.factors[l] * footprint[i] * last[i];
      for (std::size_t j = 0; j <= i; ++j, ++pair) {
        double sum = 0;
        for (int k = begins[pair]; k < begins[pair + 1]; ++k) sum += last[k];
        form.a[i][j] += goal.counts[l] * (footprint[i] * footprint[j] + off[i] * off[j]) * sum /
                        (begins[pair + 1] - begins[pair]);
      }
    }
  }
  for (int i = 0; i < form.size; ++i)
    for (int j = 0; j < i; ++j) form.a[j][i] = form.a[i][j];
  return form;
}

// Solves the n x n system in place, n <= max_rings + 1, with row pivots; false where it is singular.
using System = std::array<std::array<double, max_rings + 2>, max_rings + 1>;

bool solve(System& m, int n) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    if (std::abs(m[pivot][k]) < 1e-13) return false;
    std::swap(m[k], m[pivot]);
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = m[i][k] / m[k][k];
      for (int j = k; j <= n; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  for (int k = 0; k < n; ++k) m[k][n] /= m[k][k];
  return true;
}

// The best weights of the rings in `chosen` (bits) with sum 1, the others 0; false where one would be negative.
bool weights_of(const Quadratic& form, unsigned chosen, std::array<double, max_rings>& weights) {
  std::array<int, max_rings> index{};
  int n = 0;
  for (int i = 0; i < form.size; ++i)
    if (chosen >> i & 1u) index[n++] = i;
  System m{};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) m[i][j] = form.a[index[i]][index[j]];
    m[i][n] = m[n][i] = 1;  // the multiplier of the sum
    m[i][n + 1] = form.b[index[i]];
  }
  m[n][n + 1] = 1;
  if (!solve(m, n + 1)) return false;
  weights = {};
  for (int i = 0; i < n; ++i) {
    if (m[i][n + 1] < 0) return false;
    weights[index[i]] = m[i][n + 1];
  }
  return true;
}

// The least error over weights that are not negative: the best of all sets of rings that may be in use.
double solve_weights(const Quadratic& form, double power, Rings& rings) {
  double best = 1e300;
  for (unsigned chosen = 1; chosen < 1u << form.size; ++chosen) {
    std::array<double, max_rings> weights{};
    if (!weights_of(form, chosen, weights)) continue;
    double error = power;
    for (int i = 0; i < form.size; ++i) {
      error -= 2 * form.b[i] * weights[i];
      for (int j = 0; j < form.size; ++j) error += weights[i] * weights[j] * form.a[i][j];
    }
    if (error >= best) continue;
    best = error;
    for (int i = 0; i < form.size; ++i) rings[i].weight = weights[i];
  }
  return best;
}

// The search runs over logarithms of angles and footprints.
using Point = std::vector<double>;

double error_at(const Goal& goal, const Point& point, Rings& rings) {
  std::size_t next = 0;
  for (Ring& ring : rings) {
    ring.angle = ring.count == 1 ? 0 : std::min(std::exp(point[next++]), 0.6 * pi);
    ring.deviation = std::clamp(std::exp(point[next++]), goal.least_deviation, goal.widest);
  }
  return solve_weights(error_form(goal, rings), goal.power, rings);
}

struct Vertex {
  Point point;
  double error = 0;
};

Point along(const Point& from, const Point& to, double t) {
  Point result(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) result[i] = from[i] + t * (to[i] - from[i]);
  return result;
}

// Nelder & Mead 1965 with the usual coefficients, a fixed number of steps.
Vertex simplex_search(const Goal& goal, Rings& rings, const Point& start, double step, int steps) {
  std::vector<Vertex> simplex;
  const auto vertex = [&](Point point) {
    const double error = error_at(goal, point, rings);
    return Vertex{std::move(point), error};
  };
  simplex.push_back(vertex(start));
  for (std::size_t i = 0; i < start.size(); ++i) {
    Point moved = start;
    moved[i] += step;
    simplex.push_back(vertex(moved));
  }
  const auto better = [](const Vertex& a, const Vertex& b) { return a.error < b.error; };
  for (int k = 0; k < steps; ++k) {
    std::stable_sort(simplex.begin(), simplex.end(), better);
    Point centre(start.size());
    for (std::size_t v = 0; v + 1 < simplex.size(); ++v)
      for (std::size_t i = 0; i < start.size(); ++i)
        centre[i] += simplex[v].point[i] / static_cast<double>(start.size());
    Vertex& worst = simplex.back();
    Vertex reflected = vertex(along(centre, worst.point, -1));
    if (reflected.error < simplex.front().error) {
      Vertex expanded = vertex(along(centre, worst.point, -2));
      worst = better(expanded, reflected) ? std::move(expanded) : std::move(reflected);
    } else if (reflected.error < simplex[simplex.size() - 2].error) {
      worst = std::move(reflected);
    } else {
      Vertex contracted = vertex(along(centre, worst.point, 0.5));
      if (contracted.error < worst.error) {
        worst = std::move(contracted);
      } else {
        for (std::size_t v = 1; v < simplex.size(); ++v)
          simplex[v] = vertex(along(simplex[0].point, simplex[v].point, 0.5));
      }
    }
  }
  return *std::min_element(simplex.begin(), simplex.end(), better);
}

// Ways to share `count` taps among rings, from the inside out.
std::vector<std::vector<int>> layouts(int count) {
  const auto ring = [count](double share) {
    return std::max(2, static_cast<int>(std::lround(share * count)));
  };
  std::vector<std::vector<int>> result;
  if (count >= 3) result.push_back({1, count - 1});
  if (count < 6) return result.empty() ? std::vector<std::vector<int>>{{1, 1}} : result;
  result.push_back({ring(0.375), count - ring(0.375)});
  result.push_back({1, ring(0.34), count - 1 - ring(0.34)});
  if (count >= 12) result.push_back({1, ring(0.25), ring(0.31), count - 1 - ring(0.25) - ring(0.31)});
  if (count >= 24)
    result.push_back(
        {1, ring(0.16), ring(0.22), ring(0.28), count - 1 - ring(0.16) - ring(0.22) - ring(0.28)});
  return result;
}

// Rings at rising angles around the kernel's width, their footprints half their distance.
Point first_point(const Rings& rings, double width) {
  Point point;
  double angle = 0.5 * width;
  for (const Ring& ring : rings) {
    if (ring.count > 1) {
      point.push_back(std::log(angle));
      point.push_back(std::log(0.45 * angle));
      angle *= 2;
    } else {
      point.push_back(std::log(0.25 * width));
    }
  }
  return point;
}

QuickTaps taps_of(const Rings& rings, double predicted_rms) {
  QuickTaps result;
  result.predicted_rms = predicted_rms;
  for (const Ring& ring : rings)
    for (int k = 0; k < ring.count && ring.weight > 0; ++k) {
      const double azimuth = 2 * pi * (k + ring.offset) / ring.count, sine = std::sin(ring.angle);
      result.taps.push_back({{sine * std::cos(azimuth), sine * std::sin(azimuth), std::cos(ring.angle)},
                             ring.deviation,
                             ring.weight / ring.count});
    }
  return result;
}

}  // namespace

QuickTaps fit_quick_taps(const ZonalKernel& kernel, int count, double least_deviation) {
  if (count < 2 || count > 64) throw Error("quick filtering takes 2 to 64 taps");
  const Goal goal = make_goal(kernel, least_deviation, widest_footprint(count));
  Vertex best{{}, 1e300};
  Rings best_rings;
  for (const std::vector<int>& layout : layouts(count)) {
    Rings rings;
    for (int taps : layout) rings.push_back({taps, rings.size() % 2 == 0 ? 0.0 : 0.5});
    const Point start = first_point(rings, angular_width(kernel));
    Vertex found = simplex_search(goal, rings, start, 0.3, 150);
    found = simplex_search(goal, rings, found.point, 0.1, 100);
    if (found.error >= best.error) continue;
    best = found;
    error_at(goal, best.point, rings);
    best_rings = rings;
  }
  return taps_of(best_rings, std::sqrt(std::max(0.0, best.error) / goal.power));
}

}  // namespace welkin
