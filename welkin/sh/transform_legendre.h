#pragma once
#include <cstddef>
#include <vector>

#include <welkin/parallel/simd.h>

// The Legendre half of the spherical-harmonic transform: private to welkin/sh.
//
// Derivation. Rows lie at colatitudes theta_j, mirror images of each other in pairs: x = cos theta > 0 in the north.
// P_lm(-x) = (-1)^(l-m) P_lm(x), so even l - m take north + south (E) and odd ones north - south (O) of a pair. With
//   e_l = sqrt((l^2 - m^2) / (4 l^2 - 1)),   x P_l = e_(l+1) P_(l+1) + e_l P_(l-1)      (fully normalised),
// applying x twice gives a recurrence in steps of two degrees, l = m + 2s, and with P_l = alpha_s p_s and
// alpha_(s+1) = alpha_(s-1) e_l e_(l-1) / (e_(l+1) e_(l+2)) its last coefficient becomes 1 (Ishioka 2018):
//   p_(s+1) = (A_s x^2 + B_s) p_s - p_(s-1),
//   A_s = alpha_s / (alpha_(s+1) e_(l+1) e_(l+2)),   B_s = -A_s (e_(l+1)^2 + e_l^2),
// two multiply-adds for two degrees. The odd ones need no recurrence of their own, because
//   P_(l+1) = (e_(l+2) P_(l+2) + e_(l+1) P_l) / x:
// the same p_s are summed against O / x, and neighbouring sums are combined once at the end. So a pair of rows and two
// degrees cost 2 multiply-adds for p_s and 2 * parts for the sums.
//
// p_0 ~ sin^m theta underflows near the poles for large m: values there carry a scale of 2^-800 a unit and count as zero
// until they have grown out of it. Row pairs with m > degree sin theta + 100 (beyond the turning point of every l in
// reach; Reinecke & Seljebotn 2013, section 3.4) are skipped, as are degrees at which a block of rows is negligible.
//
// A block of rows and eight steps are done at once: first the recurrence fills a small table of p_s, then sums for four
// steps by `parts` stay in registers while the rows of the block pass by. Tables and rows fit the first-level cache.

namespace welkin::legendre {

/// Rows in pairs that lie symmetrically about the equator, none on it, from the north pole down. Arrays are padded to
/// a multiple of row_padding; what lies beyond the last pair counts for nothing.
struct RowPairs {
  static constexpr int row_padding = 8;
  int pairs = 0, padded = 0;
  std::vector<double> cos_theta, sin_theta, log_sin_theta;

  /// theta = pi (row + 1/2) / rows; rows is even.
  explicit RowPairs(int rows);
};

/// What belongs to each order m at all row pairs: parts = 2 * channels (real and imaginary part of each channel).
/// parity 0 holds E, parity 1 holds O / x (for synthesis: sums over even l - m, and over odd l - m times x).
struct OrderData {
  int max_degree = 0, padded = 0, parts = 0;
  std::vector<EightDoubles> data;

  OrderData(int degree, const RowPairs& rows, int part_count);
  /// One number a row pair.
  double* at(int m, int parity, int part) {
    return data.data()->values + ((static_cast<std::size_t>(m) * 2 + parity) * parts + part) * padded;
  }
  const double* at(int m, int parity, int part) const {
    return const_cast<OrderData*>(this)->at(m, parity, part);
  }
};

/// coefficients[(l - m) * parts + part], l = m .. max_degree, = sum over all row pairs of P_lm (E or O). parts is 2, 6
/// or 8. Returns the multiply-adds done, padding included.
std::size_t analyze_order(int m, const RowPairs& rows, const OrderData& data, double* coefficients);

/// The other way: at(m, parity, .) = sum over l of the parity of P_lm(row) coefficients[(l - m) * parts + part], times
/// x for parity 1. Overwrites all of at(m, ., .). Returns the same count.
std::size_t synthesize_order(int m, const RowPairs& rows, const double* coefficients, OrderData& data);

}  // namespace welkin::legendre
