#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sh/row_fft.h>
#include <welkin/sh/transform.h>
#include <welkin/sh/transform_legendre.h>
#include <welkin/sphere/equirect.h>

namespace welkin {
namespace {

using Complex = std::complex<double>;
using legendre::lane_count;

legendre::RowPairs place_rows(int rows) {
  legendre::RowPairs pairs(rows / 2, 1);
  for (int row = 0; row < pairs.pairs; ++row) pairs.set(row, 0, std::numbers::pi * (row + 0.5) / rows, 1);
  return pairs;
}

// One channel of lane_count northern rows and their mirror images, each pair by one complex FFT: the real part becomes
// the northern row. With F_m of a real row, f = F_0 + sum over m > 0 of F_m e^(i m phi) + conj, so
// Z_m = N_m + i S_m and Z_-m = conj N_m + i conj S_m. z holds lane_count transforms one after the other.
void gather_orders(const legendre::OrderData& data, int block, int channel, int columns,
                   const std::vector<Complex>& phases, std::vector<Complex>& z) {
  std::fill(z.begin(), z.end(), Complex{});
  for (int m = 0; m <= data.max_degree; ++m) {
    const double* even_re = data.at(m, block, 0, 2 * channel);
    const double* odd_re = data.at(m, block, 1, 2 * channel);
    for (int lane = 0; lane < lane_count; ++lane) {
      const Complex even = phases[m] * Complex(even_re[lane], even_re[lane + lane_count]);
      const Complex odd = phases[m] * Complex(odd_re[lane], odd_re[lane + lane_count]);
      const Complex north = even + odd, south = even - odd;
      Complex* row = z.data() + static_cast<std::size_t>(lane) * columns;
      row[m] = {north.real() - south.imag(), north.imag() + south.real()};
      if (m > 0) row[columns - m] = {north.real() + south.imag(), south.real() - north.imag()};
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
  const legendre::RowPairs pairs = place_rows(rows);
  legendre::OrderData data(spectrum.max_degree, pairs.blocks, 2 * spectrum.channels);
  parallel_for(spectrum.max_degree + 1, 2, [&](std::size_t begin, std::size_t end) {
    for (int m = static_cast<int>(begin); m < static_cast<int>(end); ++m)
      legendre::synthesize_order(
          m, pairs,
          reinterpret_cast<const double*>(&spectrum.values[spectrum.index(m, m) * spectrum.channels]), data);
  });

  SphereGrid grid{rows, columns, spectrum.channels, {}};
  grid.values.resize(static_cast<std::size_t>(rows + 2 * SphereGrid::margin) *
                     (columns + 2 * SphereGrid::margin) * grid.channels);
  std::vector<Complex> phases(spectrum.max_degree + 1);
  for (int m = 0; m <= spectrum.max_degree; ++m) {
    const double angle = std::numbers::pi * m / columns;
    phases[m] = (m % 2 ? -1.0 : 1.0) * Complex(std::cos(angle), std::sin(angle));
  }
  parallel_for(pairs.blocks, 2, [&](std::size_t begin, std::size_t end) {
    RowFft fft(columns, true);
    std::vector<Complex> z(static_cast<std::size_t>(columns) * lane_count), values(columns);
    for (int block = static_cast<int>(begin); block < static_cast<int>(end); ++block) {
      for (int c = 0; c < grid.channels; ++c) {
        gather_orders(data, block, c, columns, phases, z);
        for (int pair = block * lane_count; pair < std::min(pairs.pairs, (block + 1) * lane_count); ++pair) {
          fft.transform(z.data() + static_cast<std::size_t>(pair % lane_count) * columns, values.data());
          for (int x = 0; x < columns; ++x) {
            grid.at(pair, x)[c] = static_cast<float>(values[x].real());
            grid.at(rows - 1 - pair, x)[c] = static_cast<float>(values[x].imag());
          }
        }
      }
    }
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
