#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/row_fft.h>
#include <welkin/sh/transform.h>
#include <welkin/sh/transform_legendre.h>

namespace welkin {
namespace {

using Complex = std::complex<double>;
using legendre::lane_count;

// A map's rows, each cut into `split` sub-rows with the same pixels (the same function of patches), so that a few
// nodes a sub-row are enough for any degree.
struct RowLayout {
  int split = 1, rows = 0, nodes = 2;
};

RowLayout choose_rows(int height, const AnalysisOptions& options) {
  for (int split = 1;; ++split) {
    const double kappa = options.max_degree * std::numbers::pi / (2.0 * height * split);
    for (int nodes = 2; nodes <= 4; ++nodes)
      if (gauss_legendre_error(nodes, kappa) <= std::max(options.accuracy, 1e-15))
        return {split, height * split, nodes};
  }
}

// Node weights are scaled so that each row's weights give its exact integral of sin theta: constants stay exact.
// The middle row of an odd count is its own mirror image and counts half.
legendre::RowPairs place_nodes(const RowLayout& layout) {
  legendre::RowPairs pairs((layout.rows + 1) / 2, layout.nodes);
  const QuadratureRule rule = gauss_legendre(layout.nodes);
  const double half_step = std::numbers::pi / (2.0 * layout.rows);
  for (int row = 0; row < pairs.pairs; ++row) {
    const double centre = (2 * row + 1) * half_step;
    double sum = 0;
    for (int node = 0; node < layout.nodes; ++node)
      sum += rule.weights[node] * std::sin(centre + half_step * rule.nodes[node]);
    const double exact = 2 * std::sin(centre) * std::sin(half_step);
    const double share = 2 * row + 1 == layout.rows ? 0.5 : 1.0;
    for (int node = 0; node < layout.nodes; ++node) {
      const double theta = centre + half_step * rule.nodes[node];
      pairs.set(row, node, theta, share * rule.weights[node] * std::sin(theta) * exact / sum);
    }
  }
  return pairs;
}

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

// FFT of one channel of a row pair at once: north + i south. With Z its transform, north_m = (Z_m + conj Z_-m)/2 and
// south_m = (Z_m - conj Z_-m)/2i.
class RowPairFft {
 public:
  explicit RowPairFft(int width) : fft_(width, false), in_(width), out_(width) {}

  void transform(const Image& map, int north, int south, int channel) {
    const float* n = map.at(0, north) + channel;
    const float* s = map.at(0, south) + channel;
    for (int x = 0; x < map.width; ++x) in_[x] = {n[x * map.channels], s[x * map.channels]};
    fft_.transform(in_.data(), out_.data());
  }
  void split(int m, Complex& sum, Complex& difference) const {
    const int width = static_cast<int>(out_.size()), k = m % width;
    const Complex z = out_[k], mirrored = std::conj(out_[k ? width - k : 0]);
    const Complex north = 0.5 * (z + mirrored), south = Complex(0, -0.5) * (z - mirrored);
    sum = north + south;
    difference = north - south;
  }

 private:
  RowFft fft_;
  std::vector<Complex> in_, out_;
};

void transform_rows(const Image& map, const RowLayout& layout, legendre::OrderData& data) {
  const std::vector<Complex> factors = column_factors(map.width, data.max_degree);
  const int pairs = (layout.rows + 1) / 2;
  parallel_for(data.blocks, 4, [&](std::size_t begin, std::size_t end) {
    RowPairFft fft(map.width);
    for (int pair = static_cast<int>(begin) * lane_count;
         pair < std::min<int>(pairs, static_cast<int>(end) * lane_count); ++pair) {
      const int block = pair / lane_count, lane = pair % lane_count;
      for (int c = 0; c < map.channels; ++c) {
        fft.transform(map, pair / layout.split, (layout.rows - 1 - pair) / layout.split, c);
        for (int m = 0; m <= data.max_degree; ++m) {
          Complex by_parity[2];
          fft.split(m, by_parity[0], by_parity[1]);
          for (int parity = 0; parity < 2; ++parity) {
            const Complex value = factors[m] * by_parity[parity];
            data.at(m, block, parity, 2 * c)[lane] = value.real();
            data.at(m, block, parity, 2 * c + 1)[lane] = value.imag();
          }
        }
      }
    }
  });
}

}  // namespace

Spectrum analyze(const Image& equirect, const AnalysisOptions& options) {
  assert(!equirect.empty() && options.max_degree >= 0);
  assert(equirect.channels == 1 || equirect.channels == 3 || equirect.channels == 4);
  const RowLayout layout = choose_rows(equirect.height, options);
  const legendre::RowPairs rows = place_nodes(layout);
  legendre::OrderData data(options.max_degree, rows.blocks, 2 * equirect.channels);
  transform_rows(equirect, layout, data);
  Spectrum spectrum(options.max_degree, equirect.channels);
  parallel_for(options.max_degree + 1, 2, [&](std::size_t begin, std::size_t end) {
    for (int m = static_cast<int>(begin); m < static_cast<int>(end); ++m)
      legendre::analyze_order(
          m, rows, data,
          reinterpret_cast<double*>(&spectrum.values[spectrum.index(m, m) * spectrum.channels]));
  });
  return spectrum;
}

}  // namespace welkin
