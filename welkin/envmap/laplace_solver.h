#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace welkin {

/// A texel whose value is unknown, of a grid of four neighbours.
struct LaplaceTexel {
  static constexpr std::uint32_t known = UINT32_MAX;
  std::uint32_t x = 0, y = 0;
  std::array<std::uint32_t, 4> neighbours{};  ///< numbers of unknowns, or `known`; mutual
};

/// Solves 4 u_i - (sum of the unknown neighbours of i) = b_i, Laplace's equation with known surroundings, in time and
/// memory proportional to the number of unknowns whatever their shape: conjugate gradients, preconditioned by multigrid
/// over aggregates of 2 x 2 texels with a W-cycle (Braess 1995, Notay 2010). Every connected set of unknowns needs a
/// known neighbour. Private to welkin/envmap.
class LaplaceSolver {
 public:
  explicit LaplaceSolver(std::span<const LaplaceTexel> texels);

  /// u holds a first guess, and the solution afterwards, to about `tolerance`.
  void solve(std::span<const double> b, double tolerance, std::span<double> u);

 private:
  // Equation i: diagonal[i] u_i - sum of weight[k] u_column[k], k from start[i] to start[i + 1], = b_i.
  struct Level {
    std::vector<std::uint32_t> start{0}, column, parent;  // parent: the aggregate in the next level
    std::vector<float> weight;
    std::vector<double> diagonal, b, u, rest;

    double others(std::size_t i, const std::vector<double>& values) const;
    void add_row(double diagonal_entry);
    void make_room();
    void sweep_down();
    void sweep_up();
  };

  struct Cells;
  static Level first_level(std::span<const LaplaceTexel> texels);
  static Level coarsened(Level& fine, Cells& cells);
  void cycle(std::size_t k);
  void correct(std::size_t k);

  std::vector<Level> levels_;
};

}  // namespace welkin
