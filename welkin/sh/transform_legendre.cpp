#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "welkin/sh/transform_legendre.cpp"
#include <hwy/foreach_target.h>
// after foreach_target
#include <hwy/highway.h>

#include <welkin/sh/transform_legendre.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>

#ifndef WELKIN_LEGENDRE_ORDER
#define WELKIN_LEGENDRE_ORDER
namespace welkin::legendre {

// Everything that one order's kernels need. Steps beyond last_step, up to a multiple of chunk, have A = B = 0.
struct Order {
  static constexpr int chunk = 8;
  int m = 0, parts = 0, padded = 0;
  int first_row = 0;  // rows before it are skipped; a multiple of row_padding
  int steps = 0, padded_steps = 0;
  std::vector<double> a, b, alpha;       // one a step
  std::vector<double> x2, start, scale;  // one a row: cos^2, p_0 and its scale
};

constexpr int scale_bits = 800;
constexpr double negligible = 1e-55;  // of values that reach about 1: sixteen degrees later still below 1e-25
constexpr int most_block_rows = 128;

}  // namespace welkin::legendre
#endif

HWY_BEFORE_NAMESPACE();
namespace welkin::legendre {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, RowPairs::row_padding>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

constexpr int chunk = Order::chunk;

// Registers for the sums of `tile` steps or vectors by half of the parts' registers.
#if HWY_TARGET <= HWY_AVX3
constexpr int tile = 4;
#else
constexpr int tile = 2;
#endif

// Rows that are walked together from l = m upwards, and the table of p_s of the current chunk of steps,
// values[step * rows + row].
class Block {
 public:
  Block(const Order& order, int first, int rows) : order_(order), rows_(rows), awake_(rows) {
    std::memcpy(x2_, &order.x2[first], sizeof(double) * rows);
    std::memcpy(now_, &order.start[first], sizeof(double) * rows);
    std::memcpy(scale_, &order.scale[first], sizeof(double) * rows);
    std::fill_n(before_, rows, 0.0);
  }

  int rows() const { return rows_; }
  const double* values() const { return values_; }

  // Fills the table for steps s .. s + chunk - 1 and returns the first row at which they matter: those before it, nearer
  // to the pole, are negligible.
  HWY_INLINE int advance(int s) {
    const D d;
    const int n = static_cast<int>(hn::Lanes(d));
    int first = 0;  // not from awake_ upwards: the last rows of all may be padding
    while (first < awake_ && !matters(first)) first += n;
    awake_ = first;
    for (int row = 0; row < rows_; row += n) {
      const M visible = hn::Eq(hn::Load(d, scale_ + row), hn::Zero(d));
      if (hn::AllTrue(d, visible))
        step_rows(s, row);
      else
        step_scaled_rows(s, row, visible);
    }
    return awake_;
  }

 private:
  HWY_INLINE bool matters(int row) const {
    const D d;
    const M large = hn::Gt(hn::Abs(hn::Load(d, now_ + row)), hn::Set(d, negligible));
    const M visible = hn::Eq(hn::Load(d, scale_ + row), hn::Zero(d));
    return !hn::AllFalse(d, hn::And(large, visible));
  }

  HWY_INLINE void step_rows(int s, int row) {
    const D d;
    const V x2 = hn::Load(d, x2_ + row);
    V before = hn::Load(d, before_ + row), now = hn::Load(d, now_ + row);
    HWY_UNROLL(8)
    for (int k = 0; k < chunk; ++k) {
      hn::Store(now, d, values_ + k * rows_ + row);
      const V factor = hn::MulAdd(hn::Set(d, order_.a[s + k]), x2, hn::Set(d, order_.b[s + k]));
      const V next = hn::MulSub(factor, now, before);
      before = now;
      now = next;
    }
    hn::Store(before, d, before_ + row);
    hn::Store(now, d, now_ + row);
  }

  // A chunk multiplies values by less than 2^200, so those that carry a scale stay below 2^-200, and those that do not
  // never overflow.
  HWY_INLINE void step_scaled_rows(int s, int row, M visible) {
    const D d;
    step_rows(s, row);
    for (int k = 0; k < chunk; ++k) {
      double* value = values_ + k * rows_ + row;
      hn::Store(hn::IfThenElseZero(visible, hn::Load(d, value)), d, value);
    }
    const V now = hn::Load(d, now_ + row), before = hn::Load(d, before_ + row),
            scale = hn::Load(d, scale_ + row);
    const V big = hn::Set(d, std::ldexp(1.0, scale_bits / 2)),
            down = hn::Set(d, std::ldexp(1.0, -scale_bits));
    const M grown = hn::And(hn::Gt(hn::Abs(now), big), hn::Gt(scale, hn::Zero(d)));
    hn::Store(hn::IfThenElse(grown, hn::Mul(now, down), now), d, now_ + row);
    hn::Store(hn::IfThenElse(grown, hn::Mul(before, down), before), d, before_ + row);
    hn::Store(hn::IfThenElse(grown, hn::Sub(scale, hn::Set(d, 1.0)), scale), d, scale_ + row);
  }

  const Order& order_;
  int rows_;
  int awake_;
  HWY_ALIGN double x2_[most_block_rows], before_[most_block_rows], now_[most_block_rows],
      scale_[most_block_rows];
  HWY_ALIGN double values_[chunk * most_block_rows];
};

HWY_INLINE int block_rows() { return std::min(most_block_rows, 16 * static_cast<int>(hn::Lanes(D()))); }

// sums[(step * Parts + part) * lanes] += p_step(row) data(part, row) over the rows of the block, lane by lane, for
// `Steps` steps.
template <int Steps, int Parts>
HWY_INLINE void add_products(const double* values, int values_stride, const double* data, std::size_t stride,
                             int rows, double* sums) {
  const D d;
  const int n = static_cast<int>(hn::Lanes(d));
  V sum[Steps][Parts];
  HWY_UNROLL(8)
  for (int k = 0; k < Steps; ++k) {
    HWY_UNROLL(8)
    for (int part = 0; part < Parts; ++part) sum[k][part] = hn::Load(d, sums + (k * Parts + part) * n);
  }
  for (int row = 0; row < rows; row += n) {
    V value[Steps];
    HWY_UNROLL(8)
    for (int k = 0; k < Steps; ++k) value[k] = hn::Load(d, values + k * values_stride + row);
    HWY_UNROLL(8)
    for (int part = 0; part < Parts; ++part) {
      const V datum = hn::Load(d, data + part * stride + row);
      HWY_UNROLL(8)
      for (int k = 0; k < Steps; ++k) sum[k][part] = hn::MulAdd(value[k], datum, sum[k][part]);
    }
  }
  HWY_UNROLL(8)
  for (int k = 0; k < Steps; ++k) {
    HWY_UNROLL(8)
    for (int part = 0; part < Parts; ++part) hn::Store(sum[k][part], d, sums + (k * Parts + part) * n);
  }
}

// totals[(parity * padded_steps + step) * Parts + part], sums over all rows.
template <int Parts>
HWY_INLINE std::size_t analyze_rows(const Order& order, const double* data, double* totals) {
  const D d;
  const int n = static_cast<int>(hn::Lanes(d)), count = 2 * order.padded_steps * Parts;
  constexpr int steps_at_once = Parts > 6 ? tile / 2 : tile;
  std::vector<EightDoubles> memory(static_cast<std::size_t>(count) * n / RowPairs::row_padding);
  double* sums = memory.data()->values;
  const std::size_t stride = static_cast<std::size_t>(order.padded);
  std::size_t done = 0;
  for (int first = order.first_row; first < order.padded; first += block_rows()) {
    Block block(order, first, std::min(block_rows(), order.padded - first));
    for (int s = 0; s < order.padded_steps; s += chunk) {
      const int awake = block.advance(s), used = block.rows() - awake;
      done += static_cast<std::size_t>(chunk * (2 * block.rows() + 2 * Parts * used));
      if (used == 0) continue;
      for (int parity = 0; parity < 2; ++parity) {
        for (int k = 0; k < chunk; k += steps_at_once)
          add_products<steps_at_once, Parts>(
              block.values() + k * block.rows() + awake, block.rows(),
              data + parity * Parts * stride + first + awake, stride, used,
              sums + static_cast<std::size_t>(parity * order.padded_steps + s + k) * Parts * n);
      }
    }
  }
  for (int i = 0; i < count; ++i)
    totals[i] = hn::GetLane(hn::SumOfLanes(d, hn::Load(d, sums + static_cast<std::size_t>(i) * n)));
  return done;
}

// data(part, row) += sum over the chunk's steps of p_step(row) coefficients[step * Parts + part], for `Vectors` vectors
// of rows.
template <int Vectors, int Parts>
HWY_INLINE void add_steps(const double* values, int rows, const double* coefficients, double* data,
                          std::size_t stride) {
  const D d;
  const int n = static_cast<int>(hn::Lanes(d));
  V sum[Vectors][Parts];
  HWY_UNROLL(8)
  for (int v = 0; v < Vectors; ++v) {
    HWY_UNROLL(8)
    for (int part = 0; part < Parts; ++part) sum[v][part] = hn::Load(d, data + part * stride + v * n);
  }
  for (int k = 0; k < chunk; ++k) {
    V value[Vectors];
    HWY_UNROLL(8)
    for (int v = 0; v < Vectors; ++v) value[v] = hn::Load(d, values + k * rows + v * n);
    HWY_UNROLL(8)
    for (int part = 0; part < Parts; ++part) {
      const V coefficient = hn::Set(d, coefficients[k * Parts + part]);
      HWY_UNROLL(8)
      for (int v = 0; v < Vectors; ++v) sum[v][part] = hn::MulAdd(value[v], coefficient, sum[v][part]);
    }
  }
  HWY_UNROLL(8)
  for (int v = 0; v < Vectors; ++v) {
    HWY_UNROLL(8)
    for (int part = 0; part < Parts; ++part) hn::Store(sum[v][part], d, data + part * stride + v * n);
  }
}

// coefficients as totals above; data must be zero.
template <int Parts>
HWY_INLINE std::size_t synthesize_rows(const Order& order, const double* coefficients, double* data) {
  const int n = static_cast<int>(hn::Lanes(D()));
  constexpr int vectors_at_once = Parts > 6 ? tile / 2 : tile;
  const std::size_t stride = static_cast<std::size_t>(order.padded);
  std::size_t done = 0;
  for (int first = order.first_row; first < order.padded; first += block_rows()) {
    Block block(order, first, std::min(block_rows(), order.padded - first));
    for (int s = 0; s < order.padded_steps; s += chunk) {
      const int awake = block.advance(s), used = block.rows() - awake;
      done += static_cast<std::size_t>(chunk * (2 * block.rows() + 2 * Parts * used));
      if (used == 0) continue;
      for (int parity = 0; parity < 2; ++parity) {
        const double* from = coefficients + static_cast<std::size_t>(parity * order.padded_steps + s) * Parts;
        double* to = data + parity * Parts * stride + first;
        int row = awake;
        for (; row + vectors_at_once * n <= block.rows(); row += vectors_at_once * n)
          add_steps<vectors_at_once, Parts>(block.values() + row, block.rows(), from, to + row, stride);
        for (; row < block.rows(); row += n)
          add_steps<1, Parts>(block.values() + row, block.rows(), from, to + row, stride);
      }
    }
  }
  return done;
}

std::size_t analyze_any(const Order& order, const double* data, double* totals) {
  switch (order.parts) {
    case 2: return analyze_rows<2>(order, data, totals);
    case 6: return analyze_rows<6>(order, data, totals);
    default: return analyze_rows<8>(order, data, totals);
  }
}

std::size_t synthesize_any(const Order& order, const double* coefficients, double* data) {
  switch (order.parts) {
    case 2: return synthesize_rows<2>(order, coefficients, data);
    case 6: return synthesize_rows<6>(order, coefficients, data);
    default: return synthesize_rows<8>(order, coefficients, data);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace welkin::legendre
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace welkin::legendre {
namespace {

HWY_EXPORT(analyze_any);
HWY_EXPORT(synthesize_any);

// e_l of the header, squared.
double coupling_squared(double l, double m) { return l > m ? (l * l - m * m) / (4 * l * l - 1) : 0; }

// ln of P_mm / sin^m theta = sqrt((2m+1)!! / ((2m)!! 4 pi)).
double log_start(int m) {
  return 0.5 * (std::lgamma(2.0 * m + 2) - 2 * (m * std::numbers::ln2 + std::lgamma(m + 1.0)) -
                std::log(4 * std::numbers::pi));
}

// e_l for l = m .. m + count - 1.
std::vector<double> couplings(int m, int count) {
  std::vector<double> e(count);
  for (int k = 0; k < count; ++k) e[k] = std::sqrt(coupling_squared(m + k, m));
  return e;
}

void set_recurrence(Order& order, const std::vector<double>& e) {
  order.a.assign(order.padded_steps, 0.0);
  order.b.assign(order.padded_steps, 0.0);
  order.alpha.assign(order.padded_steps + 1, 1.0);
  for (int s = 0; s + 1 < order.steps; ++s) {
    const int k = 2 * s;
    const double up = e[k + 1] * e[k + 2];
    if (s > 0) order.alpha[s + 1] = order.alpha[s - 1] * e[k] * e[k - 1] / up;
    order.a[s] = order.alpha[s] / (order.alpha[s + 1] * up);
    order.b[s] = -order.a[s] * (e[k + 1] * e[k + 1] + e[k] * e[k]);
  }
}

void set_rows(Order& order, const RowPairs& rows, int max_degree) {
  order.x2.resize(rows.padded);
  order.start.assign(rows.padded, 0.0);
  order.scale.assign(rows.padded, 0.0);
  const double log_factor = log_start(order.m), reach = std::max(100.0, 0.01 * max_degree);
  order.first_row = rows.padded;
  for (int row = rows.pairs - 1; row >= 0; --row) {
    if (order.m > max_degree * rows.sin_theta[row] + reach) break;
    order.first_row = row / RowPairs::row_padding * RowPairs::row_padding;
    order.x2[row] = rows.cos_theta[row] * rows.cos_theta[row];
    double log_value = log_factor + order.m * rows.log_sin_theta[row];
    for (; log_value < -500; log_value += scale_bits * std::numbers::ln2) ++order.scale[row];
    order.start[row] = std::exp(log_value);
  }
}

Order make_order(int m, const RowPairs& rows, int max_degree, int parts, const std::vector<double>& e) {
  Order order;
  order.m = m;
  order.parts = parts;
  order.padded = rows.padded;
  order.steps = (max_degree + 1 - m) / 2 + 1;  // the sums of odd l - m need one degree more
  order.padded_steps = (order.steps + Order::chunk - 1) / Order::chunk * Order::chunk;
  set_recurrence(order, e);
  set_rows(order, rows, max_degree);
  return order;
}

}  // namespace

RowPairs::RowPairs(int rows)
    : pairs(rows / 2), padded((pairs + row_padding - 1) / row_padding * row_padding) {
  assert(rows >= 2 && rows % 2 == 0);
  cos_theta.assign(padded, 0.0);
  sin_theta.assign(padded, 0.0);
  log_sin_theta.assign(padded, 0.0);
  for (int row = 0; row < pairs; ++row) {
    const double theta = std::numbers::pi * (row + 0.5) / rows;
    cos_theta[row] = std::cos(theta);
    sin_theta[row] = std::sin(theta);
    log_sin_theta[row] = std::log(sin_theta[row]);
  }
}

OrderData::OrderData(int degree, const RowPairs& rows, int part_count)
    : max_degree(degree),
      padded(rows.padded),
      parts(part_count),
      data(static_cast<std::size_t>(degree + 1) * 2 * part_count * rows.padded / RowPairs::row_padding) {}

std::size_t analyze_order(int m, const RowPairs& rows, const OrderData& data, double* coefficients) {
  const int top = data.max_degree - m, parts = data.parts;
  const std::vector<double> e = couplings(m, top + 4);
  const Order order = make_order(m, rows, data.max_degree, parts, e);
  std::vector<double> totals(static_cast<std::size_t>(2) * order.padded_steps * parts);
  const std::size_t done = HWY_DYNAMIC_DISPATCH(analyze_any)(order, data.at(m, 0, 0), totals.data());
  const double* even = totals.data();
  const double* odd = even + static_cast<std::size_t>(order.padded_steps) * parts;
  for (int k = 0; k <= top; ++k) {
    const int s = k / 2;
    const double lower = order.alpha[s] * (k % 2 ? e[k] : 1.0),
                 upper = k % 2 ? order.alpha[s + 1] * e[k + 1] : 0;
    for (int part = 0; part < parts; ++part)
      coefficients[static_cast<std::size_t>(k) * parts + part] =
          k % 2 ? lower * odd[s * parts + part] + upper * odd[(s + 1) * parts + part]
                : lower * even[s * parts + part];
  }
  return done;
}

std::size_t synthesize_order(int m, const RowPairs& rows, const double* coefficients, OrderData& data) {
  const int top = data.max_degree - m, parts = data.parts;
  const std::vector<double> e = couplings(m, top + 4);
  const Order order = make_order(m, rows, data.max_degree, parts, e);
  std::vector<double> steps(static_cast<std::size_t>(2) * order.padded_steps * parts);
  double* even = steps.data();
  double* odd = even + static_cast<std::size_t>(order.padded_steps) * parts;
  for (int k = 0; k <= top; ++k) {
    const int s = k / 2;
    for (int part = 0; part < parts; ++part) {
      const double value = coefficients[static_cast<std::size_t>(k) * parts + part];
      if (k % 2 == 0) {
        even[s * parts + part] = order.alpha[s] * value;
      } else {
        odd[s * parts + part] += order.alpha[s] * e[k] * value;
        odd[(s + 1) * parts + part] += order.alpha[s + 1] * e[k + 1] * value;
      }
    }
  }
  std::fill_n(data.at(m, 0, 0), static_cast<std::size_t>(2) * parts * data.padded, 0.0);
  return HWY_DYNAMIC_DISPATCH(synthesize_any)(order, steps.data(), data.at(m, 0, 0));
}

}  // namespace welkin::legendre
#endif
