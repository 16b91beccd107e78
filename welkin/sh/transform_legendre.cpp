#include <welkin/sh/transform_legendre.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <welkin/parallel/target_clones.h>

#define WELKIN_INLINE inline __attribute__((always_inline))

namespace welkin::legendre {
namespace {

using Lanes = double __attribute__((vector_size(lane_count * sizeof(double))));

WELKIN_INLINE Lanes load(const double* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
WELKIN_INLINE void store(double* to, const Lanes& lanes) { std::memcpy(to, &lanes, sizeof lanes); }

constexpr int scale_bits = 800;
constexpr double negligible = 1e-40;  // of values that reach about 1, see skip_negligible

// a and c of the recurrence for one order, indexed by l - m.
struct Recurrence {
  std::vector<double> a, c;
};

Recurrence make_recurrence(int m, int max_degree) {
  Recurrence recurrence{std::vector<double>(max_degree - m + 1), std::vector<double>(max_degree - m + 1)};
  for (int l = m + 1; l <= max_degree; ++l) {
    const double ll = l, mm = m;
    recurrence.a[l - m] = std::sqrt((4 * ll * ll - 1) / (ll * ll - mm * mm));
    if (l > m + 1) recurrence.c[l - m] = recurrence.a[l - m] / recurrence.a[l - m - 1];
  }
  return recurrence;
}

// ln of P_mm / sin^m theta = sqrt((2m+1)!! / ((2m)!! 4 pi)).
double log_start(int m) {
  return 0.5 * (std::lgamma(2.0 * m + 2) - 2 * (m * std::numbers::ln2 + std::lgamma(m + 1.0)) -
                std::log(4 * std::numbers::pi));
}

// The recurrence of one block: `Nodes` nodes of lane_count row pairs, at degree l.
template <int Nodes>
struct Walk {
  Lanes x[Nodes], before[Nodes], now[Nodes];
  std::int32_t scale[Nodes][lane_count];
  bool scaled = false;
};

template <int Nodes>
WELKIN_INLINE void start(Walk<Nodes>& walk, int m, double log_factor, const RowPairs& rows, int block) {
  for (int node = 0; node < Nodes; ++node) {
    const std::size_t first = (static_cast<std::size_t>(block) * Nodes + node) * lane_count;
    walk.x[node] = load(&rows.cos_theta[first]);
    walk.before[node] = Lanes{};
    double values[lane_count];
    for (int lane = 0; lane < lane_count; ++lane) {
      double log_value = log_factor + m * rows.log_sin_theta[first + lane];
      int scale = 0;
      for (; log_value < -500; log_value += scale_bits * std::numbers::ln2) ++scale;
      values[lane] = std::exp(log_value);
      walk.scale[node][lane] = scale;
      walk.scaled |= scale > 0;
    }
    walk.now[node] = load(values);
  }
}

template <int Nodes>
WELKIN_INLINE void step(Walk<Nodes>& walk, double a, double c) {
  for (int node = 0; node < Nodes; ++node) {
    const Lanes next = (a * walk.x[node]) * walk.now[node] - c * walk.before[node];
    walk.before[node] = walk.now[node];
    walk.now[node] = next;
  }
}

// Takes lanes that have grown to 2^(scale_bits/2) one unit of scale down.
template <int Nodes>
WELKIN_INLINE void rescale(Walk<Nodes>& walk) {
  static const double big = std::ldexp(1.0, scale_bits / 2), down = std::ldexp(1.0, -scale_bits);
  walk.scaled = false;
  for (int node = 0; node < Nodes; ++node) {
    for (int lane = 0; lane < lane_count; ++lane) {
      if (walk.scale[node][lane] > 0 && std::abs(walk.now[node][lane]) > big) {
        walk.now[node][lane] *= down;
        walk.before[node][lane] *= down;
        --walk.scale[node][lane];
      }
      walk.scaled |= walk.scale[node][lane] > 0;
    }
  }
}

// The current values with lanes that still carry a scale set to zero.
template <int Nodes>
WELKIN_INLINE void visible(const Walk<Nodes>& walk, Lanes* values) {
  for (int node = 0; node < Nodes; ++node) {
    values[node] = walk.now[node];
    for (int lane = 0; lane < lane_count; ++lane)
      if (walk.scale[node][lane] > 0) values[node][lane] = 0;
  }
}

template <int Nodes>
WELKIN_INLINE bool is_negligible(const Walk<Nodes>& walk) {
  bool matters = false;
  for (int node = 0; node < Nodes; ++node) {
    const auto large = (walk.now[node] > negligible) | (walk.now[node] < -negligible);
    for (int lane = 0; lane < lane_count; ++lane) matters |= large[lane] != 0 && walk.scale[node][lane] == 0;
  }
  return !matters;
}

// Walks from l = m to the first l - m (returned, even) at which any value may matter; last + 1 where none does. Looks
// only every eighth degree: a step grows values by less than sqrt(2 l + 3), so what is skipped stays below 1e-25.
template <int Nodes>
WELKIN_INLINE int skip_negligible(Walk<Nodes>& walk, const Recurrence& recurrence, int last) {
  int i = 0;
  while (is_negligible(walk)) {
    if (i + 8 > last) return last + 1;
    for (int k = 0; k < 8; ++k) {
      ++i;
      step(walk, recurrence.a[i], recurrence.c[i]);
    }
    if (walk.scaled) rescale(walk);
  }
  return i;
}

bool beyond_turning_point(int m, int max_degree, double max_sin_theta) {
  return m > max_degree * max_sin_theta + std::max(100.0, 0.01 * max_degree);
}

template <int Nodes, int Parts>
WELKIN_INLINE void add_rows(const Lanes* values, const Lanes* weights, const double* data, double* sums) {
  Lanes q = weights[0] * values[0];
  for (int node = 1; node < Nodes; ++node) q += weights[node] * values[node];
  for (int part = 0; part < Parts; ++part)
    store(sums + part * lane_count, load(sums + part * lane_count) + q * load(data + part * lane_count));
}

template <int Nodes, int Parts>
WELKIN_INLINE void analyze_block(int m, const Recurrence& recurrence, double log_factor, const RowPairs& rows,
                                 int block, const OrderData& data, double* sums) {
  Walk<Nodes> walk;
  start(walk, m, log_factor, rows, block);
  Lanes weights[Nodes];
  for (int node = 0; node < Nodes; ++node)
    weights[node] = load(&rows.weight[(static_cast<std::size_t>(block) * Nodes + node) * lane_count]);
  const double* by_parity[2] = {data.at(m, block, 0, 0), data.at(m, block, 1, 0)};
  const int last = data.max_degree - m;
  int i = skip_negligible(walk, recurrence, last);  // l - m
  const auto add = [&](const Lanes* values) {
    add_rows<Nodes, Parts>(values, weights, by_parity[i & 1],
                           sums + static_cast<std::size_t>(i) * Parts * lane_count);
  };
  for (; walk.scaled && i <= last; ++i) {
    Lanes values[Nodes];
    visible(walk, values);
    add(values);
    if (i == last) return;
    step(walk, recurrence.a[i + 1], recurrence.c[i + 1]);
    rescale(walk);
  }
  while (i <= last) {
    add(walk.now);
    if (++i <= last) step(walk, recurrence.a[i], recurrence.c[i]);
  }
}

template <int Nodes, int Parts>
WELKIN_INLINE void analyze_blocks(int m, const RowPairs& rows, const OrderData& data, double* sums) {
  const Recurrence recurrence = make_recurrence(m, data.max_degree);
  const double log_factor = log_start(m);
  for (int block = 0; block < rows.blocks; ++block)
    if (!beyond_turning_point(m, data.max_degree, rows.max_sin_theta[block]))
      analyze_block<Nodes, Parts>(m, recurrence, log_factor, rows, block, data, sums);
}

template <int Parts>
WELKIN_INLINE void analyze_nodes(int m, const RowPairs& rows, const OrderData& data, double* sums) {
  switch (rows.nodes) {
    case 2: return analyze_blocks<2, Parts>(m, rows, data, sums);
    case 3: return analyze_blocks<3, Parts>(m, rows, data, sums);
    default: return analyze_blocks<4, Parts>(m, rows, data, sums);
  }
}

WELKIN_TARGET_CLONES void analyze_parts2(int m, const RowPairs& rows, const OrderData& data, double* sums) {
  analyze_nodes<2>(m, rows, data, sums);
}
WELKIN_TARGET_CLONES void analyze_parts6(int m, const RowPairs& rows, const OrderData& data, double* sums) {
  analyze_nodes<6>(m, rows, data, sums);
}
WELKIN_TARGET_CLONES void analyze_parts8(int m, const RowPairs& rows, const OrderData& data, double* sums) {
  analyze_nodes<8>(m, rows, data, sums);
}

template <int Parts>
WELKIN_INLINE void add_degree(const Lanes& value, const double* coefficients, Lanes* sums) {
  for (int part = 0; part < Parts; ++part) sums[part] += coefficients[part] * value;
}

template <int Parts>
WELKIN_INLINE void synthesize_block(int m, const Recurrence& recurrence, double log_factor,
                                    const RowPairs& rows, int block, const double* coefficients,
                                    OrderData& data) {
  Walk<1> walk;
  start(walk, m, log_factor, rows, block);
  Lanes sums[2][Parts] = {};
  const int last = data.max_degree - m;
  int i = skip_negligible(walk, recurrence, last);
  for (; walk.scaled && i <= last; ++i) {
    Lanes value;
    visible(walk, &value);
    add_degree<Parts>(value, coefficients + static_cast<std::size_t>(i) * Parts, sums[i & 1]);
    if (i == last) break;
    step(walk, recurrence.a[i + 1], recurrence.c[i + 1]);
    rescale(walk);
  }
  // Two degrees at a time, so that the sums of each parity stay in registers.
  for (; i + 1 <= last && !walk.scaled; i += 2) {
    add_degree<Parts>(walk.now[0], coefficients + static_cast<std::size_t>(i) * Parts, sums[i & 1]);
    step(walk, recurrence.a[i + 1], recurrence.c[i + 1]);
    add_degree<Parts>(walk.now[0], coefficients + static_cast<std::size_t>(i + 1) * Parts, sums[(i + 1) & 1]);
    if (i + 2 <= last) step(walk, recurrence.a[i + 2], recurrence.c[i + 2]);
  }
  if (i == last && !walk.scaled)
    add_degree<Parts>(walk.now[0], coefficients + static_cast<std::size_t>(i) * Parts, sums[i & 1]);
  for (int parity = 0; parity < 2; ++parity)
    for (int part = 0; part < Parts; ++part) store(data.at(m, block, parity, part), sums[parity][part]);
}

template <int Parts>
WELKIN_INLINE void synthesize_blocks(int m, const RowPairs& rows, const double* coefficients,
                                     OrderData& data) {
  const Recurrence recurrence = make_recurrence(m, data.max_degree);
  const double log_factor = log_start(m);
  for (int block = 0; block < rows.blocks; ++block)
    if (!beyond_turning_point(m, data.max_degree, rows.max_sin_theta[block]))
      synthesize_block<Parts>(m, recurrence, log_factor, rows, block, coefficients, data);
}

WELKIN_TARGET_CLONES void synthesize_parts2(int m, const RowPairs& rows, const double* from, OrderData& to) {
  synthesize_blocks<2>(m, rows, from, to);
}
WELKIN_TARGET_CLONES void synthesize_parts6(int m, const RowPairs& rows, const double* from, OrderData& to) {
  synthesize_blocks<6>(m, rows, from, to);
}
WELKIN_TARGET_CLONES void synthesize_parts8(int m, const RowPairs& rows, const double* from, OrderData& to) {
  synthesize_blocks<8>(m, rows, from, to);
}

}  // namespace

RowPairs::RowPairs(int pair_count, int nodes_per_row)
    : pairs(pair_count), blocks((pair_count + lane_count - 1) / lane_count), nodes(nodes_per_row) {
  const std::size_t count = static_cast<std::size_t>(blocks) * nodes * lane_count;
  cos_theta.assign(count, 0.0);
  log_sin_theta.assign(count, 0.0);
  weight.assign(count, 0.0);
  max_sin_theta.assign(blocks, 0.0);
}

void RowPairs::set(int pair, int node, double theta, double node_weight) {
  const int block = pair / lane_count;
  const std::size_t i = (static_cast<std::size_t>(block) * nodes + node) * lane_count + pair % lane_count;
  cos_theta[i] = std::cos(theta);
  log_sin_theta[i] = std::log(std::sin(theta));
  weight[i] = node_weight;
  max_sin_theta[block] = std::max(max_sin_theta[block], std::sin(theta));
}

OrderData::OrderData(int degree, int block_count, int part_count)
    : max_degree(degree),
      blocks(block_count),
      parts(part_count),
      data(static_cast<std::size_t>(degree + 1) * block_count * 2 * part_count * lane_count) {}

void analyze_order(int m, const RowPairs& rows, const OrderData& data, double* coefficients) {
  const std::size_t count = static_cast<std::size_t>(data.max_degree - m + 1) * data.parts;
  std::vector<double> sums(count * lane_count);
  switch (data.parts) {
    case 2: analyze_parts2(m, rows, data, sums.data()); break;
    case 6: analyze_parts6(m, rows, data, sums.data()); break;
    default: analyze_parts8(m, rows, data, sums.data()); break;
  }
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0;
    for (int lane = 0; lane < lane_count; ++lane) sum += sums[i * lane_count + lane];
    coefficients[i] = sum;
  }
}

void synthesize_order(int m, const RowPairs& rows, const double* coefficients, OrderData& data) {
  switch (data.parts) {
    case 2: return synthesize_parts2(m, rows, coefficients, data);
    case 6: return synthesize_parts6(m, rows, coefficients, data);
    default: return synthesize_parts8(m, rows, coefficients, data);
  }
}

}  // namespace welkin::legendre
