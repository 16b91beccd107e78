#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sh/batch_fft.h>
#include <welkin/sh/colatitude_series.h>
#include <welkin/sh/row_orders.h>
#include <welkin/sh/transform.h>
#include <welkin/sh/transform_legendre.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

using Complex = std::complex<double>;
constexpr int lanes = BatchFft::batch_lanes;

// One lane of north and south: row `pair` of the orders in `data` at order m.
struct PairValue {
  Complex north, south;
};

PairValue pair_value(const legendre::OrderData& data, const legendre::RowPairs& grid, int m, int channel,
                     int pair) {
  const Complex even(data.at(m, 0, 2 * channel)[pair], data.at(m, 0, 2 * channel + 1)[pair]);
  const Complex odd(data.at(m, 1, 2 * channel)[pair], data.at(m, 1, 2 * channel + 1)[pair]);
  const Complex tilted = odd / grid.cos_theta[pair];
  return {even + tilted, even - tilted};
}

// The rows of the Legendre sums are those that are wanted.
void copy_orders(const legendre::OrderData& data, const legendre::RowPairs& grid, RowOrders::Task task,
                 RowOrders& rows) {
  for (int m = task.first; m < std::min(task.first + RowOrders::orders_at_once, data.max_degree + 1); m += 2)
    for (int pair = 0; pair < grid.pairs; ++pair) {
      const PairValue value = pair_value(data, grid, m, task.channel, pair);
      double* to = rows.at(pair / lanes, task.channel, m) + pair % lanes;
      to[0] = value.north.real();
      to[lanes] = value.north.imag();
      to[2 * lanes] = value.south.real();
      to[3 * lanes] = value.south.imag();
    }
}

// More rows than the degree needs: F_m at few rows gives its series in theta, and that the others.
class FinerRows {
 public:
  FinerRows(int coarse_rows, int rows, int max_degree)
      : count_(max_degree + 1),
        coarse_rows_(coarse_rows),
        sums_(coarse_rows),
        values_(rows),
        series_(static_cast<std::size_t>(count_) * 2 * lanes) {}

  void run(const legendre::OrderData& data, const legendre::RowPairs& grid, RowOrders::Task task,
           RowOrders& rows) {
    load(data, grid, task);
    const bool sines = task.first % 2 != 0;
    sums_.sums(sines, count_, series_.data());
    for (std::size_t i = 0; i < series_.size(); ++i)
      series_[i] *= (i < static_cast<std::size_t>(2 * lanes) ? 1.0 : 2.0) / coarse_rows_;
    values_.evaluate(sines, count_, series_.data());
    store(task, rows);
  }

 private:
  void load(const legendre::OrderData& data, const legendre::RowPairs& grid, RowOrders::Task task) {
    for (int lane = 0; lane < lanes; ++lane) {
      const int m = std::min(task.first + 2 * lane, data.max_degree);
      for (int pair = 0; pair < grid.pairs; ++pair) {
        const PairValue value = pair_value(data, grid, m, task.channel, pair);
        sums_.row(pair)[lane] = value.north.real();
        sums_.row(pair)[lane + lanes] = value.north.imag();
        sums_.row(coarse_rows_ - 1 - pair)[lane] = value.south.real();
        sums_.row(coarse_rows_ - 1 - pair)[lane + lanes] = value.south.imag();
      }
    }
  }
  void store(RowOrders::Task task, RowOrders& rows) const {
    for (int lane = 0; lane < lanes; ++lane)
      for (int pair = 0; pair < rows.pairs; ++pair) {
        double* to = rows.at(pair / lanes, task.channel, task.first + 2 * lane) + pair % lanes;
        for (int part = 0; part < 2; ++part) {
          to[part * lanes] = values_.row(pair)[lane + part * lanes];
          to[(part + 2) * lanes] = values_.row(rows.height - 1 - pair)[lane + part * lanes];
        }
      }
  }

  int count_, coarse_rows_;
  ColatitudeSums sums_;
  ColatitudeValues values_;
  std::vector<double> series_;
};

RowOrders legendre_sums(const Spectrum& spectrum, int rows) {
  const int enough = smooth_row_count(spectrum.max_degree + 1);
  const bool finer = rows > enough + enough / 4;  // less is not worth the FFTs
  const legendre::RowPairs grid(finer ? enough : rows);
  legendre::OrderData data(spectrum.max_degree, grid, 2 * spectrum.channels);
  parallel_for(spectrum.max_degree + 1, 2, [&](std::size_t begin, std::size_t end) {
    for (int m = static_cast<int>(begin); m < static_cast<int>(end); ++m)
      legendre::synthesize_order(
          m, grid,
          reinterpret_cast<const double*>(&spectrum.values[spectrum.index(m, m) * spectrum.channels]), data);
  });
  RowOrders result(rows, spectrum.channels, spectrum.max_degree);
  std::optional<FinerRows> prepared;
  if (finer) prepared.emplace(enough, rows, spectrum.max_degree);
  parallel_for(result.tasks(), 2, [&](std::size_t begin, std::size_t end) {
    std::optional<FinerRows> own = prepared;
    for (int i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      if (own)
        own->run(data, grid, result.task(i), result);
      else
        copy_orders(data, grid, result.task(i), result);
    }
  });
  return result;
}

// `lanes` northern rows and their mirror images, each pair by one complex FFT: the real part becomes the northern row.
// With F_m of a real row, f = F_0 + sum over m > 0 of F_m e^(i m phi) + conj, so
// Z_m = N_m + i S_m and Z_-m = conj N_m + i conj S_m.
WELKIN_TARGET_CLONES void join_pairs(const double* __restrict from, Complex phase, double* __restrict z,
                                     double* __restrict mirrored) {
  const double c = phase.real(), s = phase.imag();
  for (int i = 0; i < lanes; ++i) {
    const double nr = from[i], ni = from[i + lanes], sr = from[i + 2 * lanes], si = from[i + 3 * lanes];
    const double north_re = c * nr - s * ni, north_im = c * ni + s * nr;
    const double south_re = c * sr - s * si, south_im = c * si + s * sr;
    mirrored[i] = north_re + south_im;
    mirrored[i + lanes] = south_re - north_im;
    z[i] = north_re - south_im;
    z[i + lanes] = north_im + south_re;
  }
}

void fill_rows(RowOrders& orders, int block, int max_degree, const std::vector<Complex>& phases,
               BatchFft& fft, SphereGrid& grid) {
  for (int c = 0; c < grid.channels; ++c) {
    if (max_degree + 1 < grid.columns - max_degree)
      std::fill(fft.at(max_degree + 1), fft.at(grid.columns - max_degree), 0.0);
    for (int m = max_degree; m > 0; --m)
      join_pairs(orders.at(block, c, m), phases[m], fft.at(m), fft.at(grid.columns - m));
    double unused[2 * lanes];
    join_pairs(orders.at(block, c, 0), phases[0], fft.at(0), unused);
    fft.transform();
    for (int lane = 0; lane < std::min(lanes, orders.pairs - block * lanes); ++lane) {
      const int pair = block * lanes + lane;
      float* north = grid.at(pair, 0) + c;
      float* south = grid.at(grid.rows - 1 - pair, 0) + c;
      for (int x = 0; x < grid.columns; ++x) {
        north[x * grid.channels] = static_cast<float>(fft.at(x)[lane]);
        south[x * grid.channels] = static_cast<float>(fft.at(x)[lane + lanes]);
      }
    }
  }
}

void fill_margins(SphereGrid& grid) {
  constexpr int margin = SphereGrid::margin;
  const auto copy = [&](int row, int column, int from_row, int from_column) {
    std::copy_n(grid.at(from_row, from_column), grid.channels, grid.at(row, column));
  };
  for (int row = 0; row < grid.rows; ++row) {
    for (int i = 1; i <= margin; ++i) {
      copy(row, -i, row, (grid.columns * margin - i) % grid.columns);
      copy(row, grid.columns + i - 1, row, (i - 1) % grid.columns);
    }
  }
  // Beyond a pole the rows come back on the opposite meridian.
  for (int i = 1; i <= margin; ++i) {
    for (int column = -margin; column < grid.columns + margin; ++column) {
      const int opposite = (column + margin * grid.columns + grid.columns / 2) % grid.columns;
      copy(-i, column, std::min(i - 1, grid.rows - 1), opposite);
      copy(grid.rows + i - 1, column, std::max(grid.rows - i, 0), opposite);
    }
  }
}

// Weights of Lagrange interpolation on the nodes -3 .. 4 at t in [0, 1).
void lagrange_weights(double t, double* weights) {
  static constexpr double scale[8] = {-1.0 / 5040, 1.0 / 720, -1.0 / 240, 1.0 / 144,
                                      -1.0 / 144,  1.0 / 240, -1.0 / 720, 1.0 / 5040};
  double left[8], right[8];
  left[0] = right[7] = 1;
  for (int i = 1; i < 8; ++i) left[i] = left[i - 1] * (t - (i - 4));
  for (int i = 6; i >= 0; --i) right[i] = right[i + 1] * (t - (i - 2));
  for (int i = 0; i < 8; ++i) weights[i] = scale[i] * left[i] * right[i];
}

}  // namespace

SphereGrid synthesize(const Spectrum& spectrum, int rows, int columns) {
  assert(rows >= 2 && rows % 2 == 0 && columns % 2 == 0 && columns > 2 * spectrum.max_degree);
  RowOrders orders = legendre_sums(spectrum, rows);
  SphereGrid grid{rows, columns, spectrum.channels, {}};
  grid.values.resize(static_cast<std::size_t>(rows + 2 * SphereGrid::margin) *
                     (columns + 2 * SphereGrid::margin) * grid.channels);
  std::vector<Complex> phases(spectrum.max_degree + 1);
  for (int m = 0; m <= spectrum.max_degree; ++m) {
    const double angle = std::numbers::pi * m / columns;
    phases[m] = (m % 2 ? -1.0 : 1.0) * Complex(std::cos(angle), std::sin(angle));
  }
  const BatchFft prepared(columns, true);
  parallel_for(orders.blocks, 1, [&](std::size_t begin, std::size_t end) {
    BatchFft fft(prepared);
    for (int block = static_cast<int>(begin); block < static_cast<int>(end); ++block)
      fill_rows(orders, block, spectrum.max_degree, phases, fft, grid);
  });
  fill_margins(grid);
  return grid;
}

void interpolate(const SphereGrid& grid, Vec3 direction, float* out) {
  const Uv uv = equirect_uv(direction);
  const double x = uv.u * grid.columns - 0.5, y = uv.v * grid.rows - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  double across[8], down[8];
  lagrange_weights(x - column, across);
  lagrange_weights(y - row, down);
  double sums[4] = {};
  for (int j = 0; j < 8; ++j) {
    const float* values = grid.at(row + j - 3, column - 3);
    double row_sums[4] = {};
    for (int i = 0; i < 8; ++i)
      for (int c = 0; c < grid.channels; ++c) row_sums[c] += across[i] * values[i * grid.channels + c];
    for (int c = 0; c < grid.channels; ++c) sums[c] += down[j] * row_sums[c];
  }
  for (int c = 0; c < grid.channels; ++c) out[c] = static_cast<float>(sums[c]);
}

}  // namespace welkin
