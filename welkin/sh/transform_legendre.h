#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

// The Legendre half of the spherical-harmonic transform: private to welkin/sh.
//
// Derivation. With F_m(theta) = integral of f exp(-i m phi) dphi, the coefficient is
//   a_lm = integral of F_m(theta) P_lm(cos theta) sin theta dtheta.
// P_lm(-x) = (-1)^(l-m) P_lm(x), so a northern row and its mirror image share one recurrence: even l-m take the sum
// of the two rows, odd l-m the difference. f is constant across a row, so the row integral of P_lm is taken first, by
// `nodes` Gauss-Legendre nodes, and multiplies the row's F_m once:
//   a_lm = sum over row pairs of q_lm(row) (F_north +- F_south),  q_lm = sum over nodes of w P_lm(cos theta_node).
// Eight row pairs make up the lanes of a SIMD vector. The recurrence of fully normalised functions,
//   P_lm = a_lm x P_(l-1)m - c_lm P_(l-2)m,
// starts at P_mm ~ sin^m theta, which underflows near the poles for large m: there values carry a scale of
// 2^-800 a unit and contribute nothing until they have grown out of it. Row pairs with m > degree sin theta + 100
// (beyond the turning point of every l in reach; Reinecke & Seljebotn 2013, section 3.4) are skipped.

namespace welkin::legendre {

inline constexpr int lane_count = 8;

/// Rows of a sphere grid in north-south pairs, cut into blocks of lane_count pairs; lanes beyond the last pair have
/// weight 0. Arrays are indexed [(block * nodes + node) * lane_count + lane].
struct RowPairs {
  int pairs = 0, blocks = 0, nodes = 1;
  std::vector<double> cos_theta, log_sin_theta, weight;
  std::vector<double> max_sin_theta;  // one a block

  RowPairs(int pair_count, int nodes_per_row);
  void set(int pair, int node, double theta, double node_weight);
};

/// Fourier coefficients F_m of all row pairs: parts = 2 * channels (real and imaginary part of each channel).
/// data[(((m * blocks + block) * 2 + parity) * parts + part) * lane_count + lane]; parity 0 holds north + south,
/// parity 1 north - south (for synthesis: the sums over even and over odd l - m).
struct OrderData {
  int max_degree = 0, blocks = 0, parts = 0;
  std::vector<double> data;

  OrderData(int degree, int block_count, int part_count);
  double* at(int m, int block, int parity, int part) {
    return data.data() +
           (((static_cast<std::size_t>(m) * blocks + block) * 2 + parity) * parts + part) * lane_count;
  }
  const double* at(int m, int block, int parity, int part) const {
    return const_cast<OrderData*>(this)->at(m, block, parity, part);
  }
};

/// coefficients[(l - m) * parts + part] for l = m .. max_degree = the sums over all row pairs. parts is 2, 6 or 8.
void analyze_order(int m, const RowPairs& rows, const OrderData& data, double* coefficients);

/// The other way: data(m, ., parity, .) = sum over l of P_lm(row) coefficients[(l - m) * parts + part]; rows.nodes
/// is 1.
void synthesize_order(int m, const RowPairs& rows, const double* coefficients, OrderData& data);

}  // namespace welkin::legendre
