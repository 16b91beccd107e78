#include <welkin/envmap/laplace_solver.h>

#include <algorithm>
#include <cmath>

// Aggregation: an aggregate has one value for its texels, u = P v. The coarse equations P^T A P v = P^T r are again a
// graph of weighted edges: weights between two aggregates add up, those within one drop out. That holds for every shape
// and across seam and poles, with no geometry but the 2 x 2 cells. Piecewise constants are a crude interpolation, so a
// single cycle gains little; two corrections a level (W) and conjugate gradients around it make up for that.

namespace welkin {

struct LaplaceSolver::Cells {
  std::vector<std::array<std::uint32_t, 2>> at;  // (y, x) of each unknown's cell
};

namespace {

constexpr std::size_t coarsest = 8;
constexpr int max_iterations = 100;

double inner(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double largest(std::span<const double> values) {
  double most = 0;
  for (double v : values) most = std::max(most, std::abs(v));
  return most;
}

}  // namespace

double LaplaceSolver::Level::others(std::size_t i, const std::vector<double>& values) const {
  double sum = 0;
  for (std::uint32_t k = start[i]; k < start[i + 1]; ++k)
    sum += static_cast<double>(weight[k]) * values[column[k]];
  return sum;
}

void LaplaceSolver::Level::add_row(double diagonal_entry) {
  start.push_back(static_cast<std::uint32_t>(column.size()));
  diagonal.push_back(diagonal_entry);
}

void LaplaceSolver::Level::make_room() {
  b.resize(diagonal.size());
  u.resize(diagonal.size());
  rest.resize(diagonal.size());
}

// Gauss-Seidel; up is the transpose of down, so that the cycle is symmetric.
void LaplaceSolver::Level::sweep_down() {
  for (std::size_t i = 0; i < diagonal.size(); ++i) u[i] = (b[i] + others(i, u)) / diagonal[i];
}
void LaplaceSolver::Level::sweep_up() {
  for (std::size_t i = diagonal.size(); i-- > 0;) u[i] = (b[i] + others(i, u)) / diagonal[i];
}

LaplaceSolver::Level LaplaceSolver::first_level(std::span<const LaplaceTexel> texels) {
  Level level;
  for (std::uint32_t i = 0; i < texels.size(); ++i) {
    double diagonal = 4;
    for (std::uint32_t n : texels[i].neighbours) {
      if (n == i) diagonal -= 1;
      if (n == i || n == LaplaceTexel::known) continue;
      level.column.push_back(n);
      level.weight.push_back(1);
    }
    level.add_row(diagonal);
  }
  level.make_room();
  return level;
}

// Sets fine.parent and leaves the cells of the aggregates in `cells`.
LaplaceSolver::Level LaplaceSolver::coarsened(Level& fine, Cells& cells) {
  for (auto& [y, x] : cells.at) y /= 2, x /= 2;
  auto all = cells.at;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const std::size_t count = fine.diagonal.size();
  fine.parent.resize(count);
  std::vector<std::uint32_t> first(all.size() + 1), children(count);  // counting sort by parent
  for (std::size_t i = 0; i < count; ++i) {
    fine.parent[i] =
        static_cast<std::uint32_t>(std::lower_bound(all.begin(), all.end(), cells.at[i]) - all.begin());
    ++first[fine.parent[i] + 1];
  }
  for (std::size_t c = 0; c < all.size(); ++c) first[c + 1] += first[c];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::size_t i = 0; i < count; ++i) children[next[fine.parent[i]]++] = static_cast<std::uint32_t>(i);
  Level coarse;
  for (std::uint32_t c = 0; c < all.size(); ++c) {
    double diagonal = 0;
    const std::size_t row = coarse.column.size();
    for (std::uint32_t child = first[c]; child < first[c + 1]; ++child) {
      const std::uint32_t i = children[child];
      diagonal += fine.diagonal[i];
      for (std::uint32_t k = fine.start[i]; k < fine.start[i + 1]; ++k) {
        const std::uint32_t other = fine.parent[fine.column[k]];
        if (other == c) {
          diagonal -= static_cast<double>(fine.weight[k]);
          continue;
        }
        const auto known = std::find(coarse.column.begin() + row, coarse.column.end(), other);
        if (known == coarse.column.end()) {
          coarse.column.push_back(other);
          coarse.weight.push_back(fine.weight[k]);
        } else {
          coarse.weight[known - coarse.column.begin()] += fine.weight[k];
        }
      }
    }
    coarse.add_row(diagonal);
  }
  coarse.make_room();
  cells.at = std::move(all);
  return coarse;
}

LaplaceSolver::LaplaceSolver(std::span<const LaplaceTexel> texels) {
  levels_.push_back(first_level(texels));
  Cells cells;
  cells.at.reserve(texels.size());
  for (const LaplaceTexel& t : texels) cells.at.push_back({t.y, t.x});
  // Ends: cells halve until one is left, or unknowns that never meet.
  for (int halving = 0; halving < 32 && levels_.back().diagonal.size() > coarsest; ++halving)
    levels_.push_back(coarsened(levels_.back(), cells));
}

// Adds the coarse solution of what is left of b.
void LaplaceSolver::correct(std::size_t k) {
  Level &fine = levels_[k], &coarse = levels_[k + 1];
  std::fill(coarse.b.begin(), coarse.b.end(), 0.0);
  for (std::size_t i = 0; i < fine.u.size(); ++i)
    coarse.b[fine.parent[i]] += fine.b[i] - fine.diagonal[i] * fine.u[i] + fine.others(i, fine.u);
  cycle(k + 1);
  for (std::size_t i = 0; i < fine.u.size(); ++i) fine.u[i] += coarse.u[fine.parent[i]];
}

// u = about A^-1 b, a symmetric positive definite operator on b.
void LaplaceSolver::cycle(std::size_t k) {
  Level& level = levels_[k];
  std::fill(level.u.begin(), level.u.end(), 0.0);
  const bool last = k + 1 == levels_.size();
  for (int sweep = 0; sweep < (last ? 20 : 1); ++sweep) {
    level.sweep_down();
    if (!last) correct(k);
    if (!last && k > 0) correct(k);
    level.sweep_up();
  }
}

// The preconditioned residual estimates the error itself, so it tells when to stop.
void LaplaceSolver::solve(std::span<const double> b, double tolerance, std::span<double> u) {
  Level& top = levels_.front();
  std::copy(u.begin(), u.end(), top.u.begin());
  std::vector<double>& residual = top.b;  // what the cycle takes
  for (std::size_t i = 0; i < u.size(); ++i)
    residual[i] = b[i] - top.diagonal[i] * u[i] + top.others(i, top.u);
  std::vector<double> direction(u.size());
  double before = 1;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    cycle(0);
    const double now = inner(residual, top.u);
    const bool done = largest(top.u) <= tolerance;
    if (!(now > 0)) return;
    for (std::size_t i = 0; i < u.size(); ++i)
      direction[i] = top.u[i] + (iteration == 0 ? 0 : now / before * direction[i]);
    for (std::size_t i = 0; i < u.size(); ++i)
      top.rest[i] = top.diagonal[i] * direction[i] - top.others(i, direction);
    const double length = now / inner(direction, top.rest);
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] += length * direction[i];
      residual[i] -= length * top.rest[i];
    }
    if (done) return;
    before = now;
  }
}

}  // namespace welkin
