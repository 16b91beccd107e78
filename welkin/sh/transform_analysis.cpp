#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sh/batch_fft.h>
#include <welkin/sh/colatitude_series.h>
#include <welkin/sh/row_orders.h>
#include <welkin/sh/transform.h>
#include <welkin/sh/transform_legendre.h>

namespace welkin {
namespace {

using Complex = std::complex<double>;
constexpr int lanes = BatchFft::batch_lanes;

// Integral over one texel column of exp(-i m phi): dphi sinc(m dphi/2) exp(-i m phi_centre), without the part that
// the FFT supplies; the first column's centre lies at -pi + dphi/2.
std::vector<Complex> column_factors(int width, int max_degree) {
  std::vector<Complex> factors(max_degree + 1);
  const double step = 2 * std::numbers::pi / width;
  for (int m = 0; m <= max_degree; ++m) {
    const double half = 0.5 * m * step;
    const double patch = step * (m > 0 ? std::sin(half) / half : 1.0);
    factors[m] = (m % 2 ? -patch : patch) * Complex(std::cos(half), -std::sin(half));
  }
  return factors;
}

// One channel of `lanes` pairs of rows as north + i south; lanes beyond the last pair repeat it.
void load_pairs(const Image& map, int first_pair, int pairs, int channel, BatchFft& fft) {
  const float *north[lanes], *south[lanes];
  for (int lane = 0; lane < lanes; ++lane) {
    const int pair = std::min(first_pair + lane, pairs - 1);
    north[lane] = map.at(0, pair) + channel;
    south[lane] = map.at(0, map.height - 1 - pair) + channel;
  }
  for (int x = 0; x < map.width; ++x) {
    double* to = fft.at(x);
    const std::size_t offset = static_cast<std::size_t>(x) * map.channels;
    for (int lane = 0; lane < lanes; ++lane) {
      to[lane] = north[lane][offset];
      to[lanes + lane] = south[lane][offset];
    }
  }
}

// With Z the transform of north + i south, north_m = (Z_m + conj Z_-m)/2 and south_m = (Z_m - conj Z_-m)/2i; both times
// `factor`.
WELKIN_TARGET_CLONES void split_pairs(const double* __restrict z, const double* __restrict mirrored,
                                      Complex factor, double* __restrict out) {
  const double c = 0.5 * factor.real(), s = 0.5 * factor.imag();
  for (int i = 0; i < lanes; ++i) {
    const double north_re = z[i] + mirrored[i], north_im = z[i + lanes] - mirrored[i + lanes];
    const double south_re = z[i + lanes] + mirrored[i + lanes], south_im = mirrored[i] - z[i];
    out[i] = c * north_re - s * north_im;
    out[i + lanes] = c * north_im + s * north_re;
    out[i + 2 * lanes] = c * south_re - s * south_im;
    out[i + 3 * lanes] = c * south_im + s * south_re;
  }
}

void replace_texels(const std::vector<AnalysisOptions::Replaced>& replaced, int height, int first_pair,
                    int channel, BatchFft& fft) {
  for (const AnalysisOptions::Replaced& texel : replaced)
    for (const bool south : {false, true}) {
      const int lane = (south ? height - 1 - texel.y : texel.y) - first_pair;
      if (lane < 0 || lane >= lanes || 2 * (first_pair + lane) >= height + height % 2) continue;
      fft.at(texel.x)[lane + (south ? lanes : 0)] = static_cast<double>(texel.value[channel]);
    }
}

RowOrders transform_rows(const Image& map, const AnalysisOptions& options) {
  const int max_degree = options.max_degree;
  RowOrders rows(map.height, map.channels, max_degree);
  const std::vector<Complex> factors = column_factors(map.width, max_degree);
  const BatchFft prepared(map.width);
  parallel_for(rows.blocks, 1, [&](std::size_t begin, std::size_t end) {
    BatchFft fft(prepared);
    for (int block = static_cast<int>(begin); block < static_cast<int>(end); ++block)
      for (int c = 0; c < map.channels; ++c) {
        load_pairs(map, block * lanes, rows.pairs, c, fft);
        replace_texels(options.replaced, map.height, block * lanes, c, fft);
        fft.transform();
        for (int m = 0; m <= max_degree; ++m) {
          const int k = m % map.width;
          split_pairs(fft.at(k), fft.at((map.width - k) % map.width), factors[m], rows.at(block, c, m));
        }
      }
  });
  return rows;
}

// The rows of one channel at orders first, first + 2, ... of one parity, to the grid of the Legendre sums.
void load_orders(RowOrders& rows, RowOrders::Task task, PatchRows& series) {
  for (int block = 0; block < rows.blocks; ++block)
    for (int lane = 0; lane < lanes; ++lane) {
      const double* from = rows.at(block, task.channel, task.first + 2 * lane);
      for (int i = 0; i < lanes; ++i) {
        const int pair = block * lanes + i;
        if (pair >= rows.pairs) break;
        double* south = series.row(rows.height - 1 - pair);
        south[lane] = from[i + 2 * lanes];
        south[lane + lanes] = from[i + 3 * lanes];
        double* north = series.row(pair);  // the middle row of an odd height is its own mirror image
        north[lane] = from[i];
        north[lane + lanes] = from[i + lanes];
      }
    }
}

void store_orders(const PatchRows& series, const legendre::RowPairs& grid, RowOrders::Task task,
                  legendre::OrderData& data) {
  const int grid_rows = 2 * grid.pairs;
  const double weight = std::numbers::pi / grid_rows;
  for (int lane = 0; lane < lanes && task.first + 2 * lane <= data.max_degree; ++lane) {
    const int m = task.first + 2 * lane;
    for (int part = 0; part < 2; ++part) {
      double* even = data.at(m, 0, 2 * task.channel + part);
      double* odd = data.at(m, 1, 2 * task.channel + part);
      for (int pair = 0; pair < grid.pairs; ++pair) {
        const double north = series.grid_row(pair)[lane + part * lanes],
                     south = series.grid_row(grid_rows - 1 - pair)[lane + part * lanes];
        even[pair] = weight * (north + south);
        odd[pair] = weight * (north - south) / grid.cos_theta[pair];
      }
    }
  }
}

legendre::OrderData resample_rows(RowOrders rows, int max_degree, const legendre::RowPairs& grid) {
  legendre::OrderData data(max_degree, grid, 2 * rows.channels);
  const PatchRows prepared(rows.height, max_degree, 2 * grid.pairs);
  parallel_for(rows.tasks(), 2, [&](std::size_t begin, std::size_t end) {
    PatchRows series(prepared);
    for (int i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      const RowOrders::Task task = rows.task(i);
      load_orders(rows, task, series);
      series.to_grid(task.first % 2 != 0);
      store_orders(series, grid, task, data);
    }
  });
  return data;
}

}  // namespace

Spectrum analyze(const Image& equirect, const AnalysisOptions& options) {
  assert(!equirect.empty() && options.max_degree >= 0);
  assert(equirect.channels == 1 || equirect.channels == 3 || equirect.channels == 4);
  const legendre::RowPairs grid(smooth_row_count(options.max_degree + 1));
  const legendre::OrderData data = resample_rows(transform_rows(equirect, options), options.max_degree, grid);
  Spectrum spectrum(options.max_degree, equirect.channels);
  parallel_for(options.max_degree + 1, 2, [&](std::size_t begin, std::size_t end) {
    for (int m = static_cast<int>(begin); m < static_cast<int>(end); ++m)
      legendre::analyze_order(
          m, grid, data,
          reinterpret_cast<double*>(&spectrum.values[spectrum.index(m, m) * spectrum.channels]));
  });
  return spectrum;
}

}  // namespace welkin
