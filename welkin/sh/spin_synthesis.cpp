#include <welkin/sh/spin_synthesis.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sh/batch_fft.h>
#include <welkin/sphere/equirect.h>

// Derivation. Let u = (x, z, y) of the world, so that the equirectangular azimuth is right-handed about u_3, and
// R = Z(b) Y(a) the rotation that takes the pole to the direction with polar angle a and azimuth b, u_1 to e_theta
// and u_2 to e_phi. For the usual Y_lm (with Condon-Shortley sign) and D^l_mq(b, a, 0) = e^(-imb) d^l_mq(a),
//   Y_lm(R w) = sum over q of conj(D^l_mq) Y_lq(w),
// so f = sum of a_lm Y_lm has around the direction (a, b) the coefficients
//   c_lq(a, b) = sum over m of a_lm d^l_mq(a) e^(imb).
// The functions of spectrum.h are S_lm = e_m Y_lm, e_m = (-1)^m for m > 0 and else 1; for them d becomes
// e_m e_q d^l_mq. Real functions: a_l-m = conj a_lm, c_l-q = conj c_lq.
// At fixed m and q >= 0 the functions follow in l from l0 = max(|m|, q) on by (Kostelec & Rockmore 2008)
//   d^(l+1) = ((2l+1) [(l+1) cos a - mq/l] d^l - (l+1)/l sqrt((l^2-m^2)(l^2-q^2)) d^(l-1))
//             / sqrt(((l+1)^2-m^2)((l+1)^2-q^2)),
// where with c = cos(a/2), s = sin(a/2) the start is, up to the sign given below,
//   d^j_jq = sqrt(binomial(2j, j+q)) c^(j+q) s^(j-q).

namespace welkin {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr int lanes = BatchFft::batch_lanes;  // rows that are worked on together

// d^l0_mq at the half angle whose logarithms of cosine and sine are given, times e_m e_q.
double starting_value(int m, int q, double log_cos, double log_sin) {
  const int j = std::max(std::abs(m), q);
  // Powers of c and s: for m = j they are j + q and j - q, for m = -j the other way; for q = j, j + m and j - m.
  const int power = std::abs(m) >= q ? (m >= 0 ? j + q : j - q) : j + m;
  const double log_value =
      0.5 * (std::lgamma(2.0 * j + 1) - std::lgamma(power + 1.0) - std::lgamma(2.0 * j - power + 1)) +
      power * log_cos + (2 * j - power) * log_sin;
  const bool odd_d = std::abs(m) >= q && m >= 0 && (j - q) % 2 != 0;
  const bool odd_signs = ((m > 0 ? m : 0) + q) % 2 != 0;
  return (odd_d != odd_signs ? -1 : 1) * std::exp(log_value);
}

struct RowBlock {
  int first = 0, count = 0;
  double cos_theta[lanes], log_cos[lanes], log_sin[lanes];

  RowBlock(int first_row, int rows) : first(first_row), count(std::min(lanes, rows - first_row)) {
    for (int i = 0; i < lanes; ++i) {
      const double theta = pi * (first + std::min(i, count - 1) + 0.5) / rows;
      cos_theta[i] = std::cos(theta);
      log_cos[i] = std::log(std::cos(theta / 2));
      log_sin[i] = std::log(std::sin(theta / 2));
    }
  }
};

WELKIN_TARGET_CLONES void step(double scale, double shift, double back, const double* cos_theta,
                               const double* current, const double* previous, double* next) {
  for (int i = 0; i < lanes; ++i) next[i] = (scale * cos_theta[i] - shift) * current[i] - back * previous[i];
}

// table[(l - l0) * lanes + lane] for l = l0 .. max_degree.
void wigner_column(int m, int q, int max_degree, const RowBlock& rows, std::vector<double>& table) {
  const int l0 = std::max(std::abs(m), q);
  table.resize(static_cast<std::size_t>(max_degree - l0 + 1) * lanes);
  for (int i = 0; i < lanes; ++i) table[i] = starting_value(m, q, rows.log_cos[i], rows.log_sin[i]);
  const double zeros[lanes] = {};
  for (int l = l0; l < max_degree; ++l) {
    const double n = l + 1, mm = static_cast<double>(m) * m, qq = static_cast<double>(q) * q;
    const double over = 1 / std::sqrt((n * n - mm) * (n * n - qq));
    const double shift = l > 0 ? (2.0 * l + 1) * m * q / l * over : 0;
    const double back = l > l0 ? n / l * std::sqrt((1.0 * l * l - mm) * (1.0 * l * l - qq)) * over : 0;
    double* current = &table[static_cast<std::size_t>(l - l0) * lanes];
    step((2.0 * l + 1) * n * over, shift, back, rows.cos_theta, current, l > l0 ? current - lanes : zeros,
         current + lanes);
  }
}

// sums[(2 j + part) * lanes + lane] = sum over l of weights[l * 4 + j] table[(l * 2 + part) * lanes + lane], j < 4.
WELKIN_TARGET_CLONES void sum_degrees(const double* weights, const double* table, int degrees, double* sums) {
  double re0[lanes] = {}, re1[lanes] = {}, re2[lanes] = {}, re3[lanes] = {};
  double im0[lanes] = {}, im1[lanes] = {}, im2[lanes] = {}, im3[lanes] = {};
  for (int l = 0; l < degrees; ++l) {
    const double* w = weights + 4 * l;
    const double* re = table + static_cast<std::size_t>(l) * 2 * lanes;
    const double* im = re + lanes;
    for (int i = 0; i < lanes; ++i) re0[i] += w[0] * re[i];
    for (int i = 0; i < lanes; ++i) im0[i] += w[0] * im[i];
    for (int i = 0; i < lanes; ++i) re1[i] += w[1] * re[i];
    for (int i = 0; i < lanes; ++i) im1[i] += w[1] * im[i];
    for (int i = 0; i < lanes; ++i) re2[i] += w[2] * re[i];
    for (int i = 0; i < lanes; ++i) im2[i] += w[2] * im[i];
    for (int i = 0; i < lanes; ++i) re3[i] += w[3] * re[i];
    for (int i = 0; i < lanes; ++i) im3[i] += w[3] * im[i];
  }
  const double* parts[8] = {re0, im0, re1, im1, re2, im2, re3, im3};
  for (int j = 0; j < 8; ++j) std::copy_n(parts[j], lanes, sums + j * lanes);
}

// out[(l * 2 + part) * lanes + lane] = part of a_l times table[l * lanes + lane].
WELKIN_TARGET_CLONES void scale_column(const double* re, const double* im, const double* table, int degrees,
                                       double* out) {
  for (int l = 0; l < degrees; ++l) {
    for (int i = 0; i < lanes; ++i) out[2 * l * lanes + i] = re[l] * table[l * lanes + i];
    for (int i = 0; i < lanes; ++i) out[(2 * l + 1) * lanes + i] = im[l] * table[l * lanes + i];
  }
}

Complex coefficient(const Spectrum& spectrum, int l, int m, int channel) {
  const Complex a = spectrum.values[spectrum.index(l, std::abs(m)) * spectrum.channels + channel];
  return m < 0 ? std::conj(a) : a;
}

// The filters of one spin. Channel by channel they are summed in fours: weights[((channel * fours + four) *
// (max_degree + 1) + l) * 4 + j] is the factor of the filter 4 four + j.
struct SpinGroup {
  int spin = 0, filters = 0, fours = 0, channels = 0, max_degree = 0;
  std::vector<double> weights;

  SpinGroup(std::span<const SpinFilter> group, const Spectrum& spectrum)
      : spin(group.front().spin),
        filters(static_cast<int>(group.size())),
        fours((filters + 3) / 4),
        channels(spectrum.channels),
        max_degree(spectrum.max_degree) {
    weights.resize(static_cast<std::size_t>(channels) * fours * (max_degree + 1) * 4);
    for (int f = 0; f < filters; ++f)
      for (int l = 0; l <= max_degree; ++l)
        for (int c = 0; c < channels; ++c) at(c, f / 4, l)[f % 4] = group[f].factors[l * channels + c];
  }
  double* at(int channel, int four, int l) {
    return &weights[((static_cast<std::size_t>(channel) * fours + four) * (max_degree + 1) + l) * 4];
  }
  const double* at(int channel, int four, int l) const {
    return const_cast<SpinGroup*>(this)->at(channel, four, l);
  }
  int series() const { return filters * channels; }
  int parts() const { return spin > 0 ? 2 : 1; }  // real maps a filter
};

// Fourier coefficients in azimuth of a group, the series being filter * channels + channel: real parts of all lanes
// and then their imaginary parts; from m = -degree on. And the rows that they give.
struct SpinOrders {
  int degree = 0;
  std::vector<double> orders, table, re, im, scaled;
  std::vector<float> lines;  // [(column * slots * channels + slot * channels + channel) * lanes + lane]

  double* at(int series, int m) {
    return &orders[(static_cast<std::size_t>(series) * (2 * degree + 1) + m + degree) * 2 * lanes];
  }
};

void turn(Complex phase, const double* sums, double* to) {
  for (int i = 0; i < lanes; ++i) {
    to[i] = phase.real() * sums[i] - phase.imag() * sums[i + lanes];
    to[i + lanes] = phase.real() * sums[i + lanes] + phase.imag() * sums[i];
  }
}

void gather_spin_orders(const Spectrum& spectrum, const SpinGroup& group, const RowBlock& rows,
                        const std::vector<Complex>& phases, SpinOrders& out) {
  const int degree = spectrum.max_degree;
  out.orders.assign(static_cast<std::size_t>(group.series()) * (2 * degree + 1) * 2 * lanes, 0.0);
  double sums[8 * lanes];
  for (int m = -degree; m <= degree; ++m) {
    const int l0 = std::max(std::abs(m), group.spin), degrees = degree - l0 + 1;
    if (degrees <= 0) continue;
    wigner_column(m, group.spin, degree, rows, out.table);
    out.re.resize(degrees);
    out.im.resize(degrees);
    out.scaled.resize(static_cast<std::size_t>(degrees) * 2 * lanes);
    const Complex phase = m < 0 ? std::conj(phases[-m]) : phases[m];
    for (int c = 0; c < group.channels; ++c) {
      for (int l = l0; l <= degree; ++l) {
        const Complex a = coefficient(spectrum, l, m, c);
        out.re[l - l0] = a.real();
        out.im[l - l0] = a.imag();
      }
      scale_column(out.re.data(), out.im.data(), out.table.data(), degrees, out.scaled.data());
      for (int f = 0; f < group.filters; ++f) {
        if (f % 4 == 0) sum_degrees(group.at(c, f / 4, l0), out.scaled.data(), degrees, sums);
        turn(phase, sums + f % 4 * 2 * lanes, out.at(f * group.channels + c, m));
      }
    }
  }
}

void transform_series(SpinOrders& orders, const SpinGroup& group, BatchFft& fft) {
  const int columns = fft.length(), degree = orders.degree, parts = group.parts(),
            run = group.series() * parts;
  orders.lines.resize(static_cast<std::size_t>(run) * columns * lanes);
  for (int s = 0; s < group.series(); ++s) {
    for (int k = degree + 1; k < columns - degree; ++k) std::fill_n(fft.at(k), 2 * lanes, 0.0);
    for (int m = -degree; m <= degree; ++m)
      std::copy_n(orders.at(s, m), 2 * lanes, fft.at(m < 0 ? columns + m : m));
    fft.transform();
    for (int part = 0; part < parts; ++part) {
      const int place = (s / group.channels * parts + part) * group.channels + s % group.channels;
      for (int column = 0; column < columns; ++column) {
        float* line = &orders.lines[(static_cast<std::size_t>(column) * run + place) * lanes];
        const double* value = fft.at(column) + part * lanes;
        for (int i = 0; i < lanes; ++i) line[i] = static_cast<float>(value[i]);
      }
    }
  }
}

WELKIN_TARGET_CLONES void take_lane(const float* from, int count, float* to) {
  for (int k = 0; k < count; ++k) to[k] = from[k * lanes];
}

// `first_slot` is where the group stands in a texel.
void write_rows(const SpinOrders& orders, const SpinGroup& group, const RowBlock& rows, int first_slot,
                SpinGrid& grid) {
  const int run = group.series() * group.parts();
  for (int column = 0; column < grid.columns; ++column)
    for (int i = 0; i < rows.count; ++i)
      take_lane(
          &orders.lines[static_cast<std::size_t>(column) * run * lanes + i], run,
          &grid.values[(static_cast<std::size_t>(rows.first + i) * grid.columns + column) * grid.stride() +
                       first_slot * grid.channels]);
}

std::vector<SpinGroup> make_groups(std::span<const SpinFilter> filters, const Spectrum& spectrum) {
  std::vector<SpinGroup> groups;
  for (std::size_t first = 0, last; first < filters.size(); first = last) {
    for (last = first; last < filters.size() && filters[last].spin == filters[first].spin;) ++last;
    groups.emplace_back(filters.subspan(first, last - first), spectrum);
  }
  return groups;
}

}  // namespace

Mat3 spin_frame(Vec3 direction) {
  const double radius = std::hypot(direction.x, direction.z);
  const double cos_b = radius > 0 ? direction.x / radius : 1, sin_b = radius > 0 ? direction.z / radius : 0;
  return {{Vec3{direction.y * cos_b, -radius, direction.y * sin_b}, Vec3{-sin_b, 0, cos_b}, direction}};
}

SpinGrid synthesize_spin(const Spectrum& spectrum, std::span<const SpinFilter> filters, int rows,
                         int columns) {
  assert(spectrum.max_degree <= max_spin_degree && rows >= 8 && rows % 2 == 0);
  assert(columns > 2 * spectrum.max_degree && columns % 2 == 0);
  SpinGrid grid{rows, columns, spectrum.channels, {}, {}};
  for (const SpinFilter& filter : filters)
    grid.slot_spin.insert(grid.slot_spin.end(), filter.spin > 0 ? 2 : 1, filter.spin);
  grid.values.resize(static_cast<std::size_t>(rows) * columns * grid.stride());
  std::vector<Complex> phases(spectrum.max_degree + 1);
  for (int m = 0; m <= spectrum.max_degree; ++m) phases[m] = std::polar(1.0, m * (pi / columns - pi));
  const BatchFft prepared(columns, true);
  const std::vector<SpinGroup> groups = make_groups(filters, spectrum);
  parallel_for((rows + lanes - 1) / lanes, 1, [&](std::size_t begin, std::size_t end) {
    BatchFft fft(prepared);
    SpinOrders orders;
    orders.degree = spectrum.max_degree;
    for (std::size_t block = begin; block < end; ++block) {
      const RowBlock block_rows(static_cast<int>(block) * lanes, rows);
      int slot = 0;
      for (const SpinGroup& group : groups) {
        gather_spin_orders(spectrum, group, block_rows, phases, orders);
        transform_series(orders, group, fft);
        write_rows(orders, group, block_rows, slot, grid);
        slot += group.filters * group.parts();
      }
    }
  });
  return grid;
}

namespace {

// Weights of Lagrange interpolation on the nodes -3 .. 4 at t in [0, 1).
void lagrange_weights(double t, double* weights) {
  static constexpr double scale[8] = {-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                      -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  for (int i = 0; i < 8; ++i) {
    weights[i] = scale[i];
    for (int j = 0; j < 8; ++j)
      if (j != i) weights[i] *= t - (j - 3);
  }
}

WELKIN_TARGET_CLONES void add_scaled(float weight, const float* values, float* sums, int count) {
  for (int i = 0; i < count; ++i) sums[i] += weight * values[i];
}

}  // namespace

void interpolate(const SpinGrid& grid, Vec3 direction, std::span<float> out) {
  const int stride = grid.stride();
  assert(out.size() == static_cast<std::size_t>(stride));
  const Uv uv = equirect_uv(direction);
  const double x = uv.u * grid.columns - 0.5, y = uv.v * grid.rows - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  double across[8], down[8];
  lagrange_weights(x - column, across);
  lagrange_weights(y - row, down);
  std::vector<float> beyond;  // what comes from beyond a pole: odd spins change their sign there
  std::fill(out.begin(), out.end(), 0.0f);
  for (int j = 0; j < 8; ++j) {
    const int r = row + j - 3;
    const bool crossed = r < 0 || r >= grid.rows;
    if (crossed && beyond.empty()) beyond.assign(stride, 0.0f);
    const int from_row = r < 0 ? -1 - r : crossed ? 2 * grid.rows - 1 - r : r;
    for (int i = 0; i < 8; ++i) {
      const int c = (column + i - 3 + (crossed ? grid.columns / 2 : 0) + 2 * grid.columns) % grid.columns;
      add_scaled(static_cast<float>(across[i] * down[j]),
                 &grid.values[(static_cast<std::size_t>(from_row) * grid.columns + c) * stride],
                 crossed ? beyond.data() : out.data(), stride);
    }
  }
  for (std::size_t k = 0; k < beyond.size(); ++k)
    out[k] += grid.slot_spin[k / grid.channels] % 2 ? -beyond[k] : beyond[k];
}

}  // namespace welkin
