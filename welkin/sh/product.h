#pragma once
#include <cstdint>
#include <vector>

#include <welkin/sh/projection.h>

// Products of functions given by coefficients. The product of functions of degrees a and b has degree a + b; all of it is
// there, and cutting it is the caller's choice. Everything rests on one fact: a Gauss-Legendre rule in z times equally
// spaced azimuths integrates products of spherical harmonics exactly, up to rounding.

namespace welkin {

/// The largest degree of a product.
inline constexpr int max_product_degree = 256;

/// The coefficients of f g to max_degree, exact whatever is cut off; by default to the full degree a + b. Channel by
/// channel. Throws Error when a set is malformed, the channels differ, or max_degree or a + b exceeds
/// max_product_degree.
ShCoefficients product(const ShCoefficients& f, const ShCoefficients& g);
ShCoefficients product(const ShCoefficients& f, const ShCoefficients& g, int max_degree);

/// The integral of f g h over the sphere, one per channel (Snyder 2006 needs it for light times visibility times
/// reflectance). Throws as product does.
std::vector<double> triple_product(const ShCoefficients& f, const ShCoefficients& g, const ShCoefficients& h);

/// The integral of Y_i Y_j Y_k.
struct TripleProductEntry {
  std::uint16_t i = 0, j = 0, k = 0;  // indices l (l + 1) + m, i <= j, any k
  double value = 0;
};

/// The integrals of Y_i Y_j Y_k that are not 0, for real harmonics up to max_degree (the Gaunt coefficients of the
/// real basis), i <= j: for those who multiply many small sets of one degree. 52 of the 405 triples to degree 2.
struct TripleProductTable {
  int max_degree = -1;
  std::vector<TripleProductEntry> entries;  // sorted by i, then j, then k
};

inline constexpr int max_triple_product_degree = 12;

/// The table by closed-form azimuth integrals and exact quadrature in z. Throws Error when max_degree is not in
/// [0, max_triple_product_degree].
TripleProductTable make_triple_product_table(int max_degree);

/// product(f, g, table.max_degree) by the table; f and g have exactly its degree, else Error.
ShCoefficients product(const TripleProductTable& table, const ShCoefficients& f, const ShCoefficients& g);

/// The matrix of g -> product(f, g, out_degree) for g of degree in_degree and a fixed f of one channel: row-major,
/// sh_count(out_degree) x sh_count(in_degree); symmetric where both are equal. Throws Error when f is malformed, has more
/// channels, or in_degree or out_degree is not in [0, 32].
std::vector<double> product_matrix(const ShCoefficients& f, int in_degree, int out_degree);

}  // namespace welkin
