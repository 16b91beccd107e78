#include <complex>
#include <cstring>
#include <numbers>
#include <random>

#include "measure.h"

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/transform.h>
#include <welkin/sphere/equirect.h>

// The fast spherical-harmonic transform on maps of white noise, which has no gentle degrees. Analysis is compared with
// patch integrals in long double, synthesis with the sum over all functions. Rates count 15 operations a coefficient
// and row pair (12 to add three complex channels, 3 for the recurrence), done or skipped; the yardsticks are
// multiply-adds in registers and a copy in memory.

namespace {

using namespace welkin;

using Wide = long double;

Image noise(int width, int height) {
  Image map(width, height);
  std::mt19937 random(5);
  for (float& p : map.pixels) p = static_cast<float>(random() >> 8) / 16777216.0f;
  return map;
}

// P_lm(cos theta) for l = m .. max_degree: fully normalised, no Condon-Shortley sign.
void legendre_column(int m, int max_degree, Wide theta, std::vector<Wide>& out) {
  const Wide x = std::cos(theta), s = std::sin(theta);
  Wide p = std::sqrt(1 / (4 * std::numbers::pi_v<Wide>));
  for (int k = 1; k <= m; ++k) p *= s * std::sqrt((2 * k + Wide{1}) / (2 * k));
  Wide before = 0, factor_before = 1;
  for (int l = m; l <= max_degree; ++l) {
    out[l - m] = p;
    const Wide d = l + 1;
    const Wide factor = std::sqrt((4 * d * d - 1) / (d * d - Wide{1} * m * m));
    const Wide next = factor * (x * p - before / factor_before);
    before = p;
    p = next;
    factor_before = factor;
  }
}

// The coefficients a_lm of red, l = m .. max_degree, by 6 Gauss nodes a row and exact azimuth integrals.
std::vector<std::complex<Wide>> oracle_order(const Image& map, int m, int max_degree) {
  std::vector<std::complex<Wide>> sums(max_degree - m + 1);
  std::vector<Wide> column(sums.size());
  const QuadratureRule rule = gauss_legendre(6);
  const Wide half = std::numbers::pi_v<Wide> / (2 * map.height),
             step = 2 * std::numbers::pi_v<Wide> / map.width;
  const Wide width =
      m == 0 ? step : 2 * std::sin(m * step / 2) / m;  // integral of exp(-i m phi) over a texel
  std::vector<std::complex<Wide>> wave(map.width);
  for (int x = 0; x < map.width; ++x)
    wave[x] = std::polar(width, -m * (step * (x + Wide{0.5}) - std::numbers::pi_v<Wide>));
  for (int y = 0; y < map.height; ++y) {
    std::complex<Wide> f = 0;
    for (int x = 0; x < map.width; ++x) f += wave[x] * static_cast<Wide>(map.at(x, y)[0]);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const Wide theta = half * (2 * y + 1 + static_cast<Wide>(rule.nodes[i]));
      legendre_column(m, max_degree, theta, column);
      const Wide weight = half * static_cast<Wide>(rule.weights[i]) * std::sin(theta);
      for (std::size_t l = 0; l < sums.size(); ++l) sums[l] += weight * column[l] * f;
    }
  }
  return sums;
}

double analysis_error(const Image& map, const Spectrum& spectrum) {
  Wide error = 0, truth = 0;
  for (int m : {0, 3, spectrum.max_degree / 2, spectrum.max_degree}) {
    const auto exact = oracle_order(map, m, spectrum.max_degree);
    for (int l = std::max(m, 1); l <= spectrum.max_degree; ++l) {  // the mean would outweigh all else
      const std::complex<Wide> a = spectrum.values[spectrum.index(l, m) * spectrum.channels];
      error += std::norm(a - exact[l - m]);
      truth += std::norm(exact[l - m]);
    }
  }
  return static_cast<double>(std::sqrt(error / truth));
}

double synthesis_error(const Spectrum& spectrum, const SphereGrid& grid) {
  std::mt19937 random(9);
  double error = 0, truth = 0;
  for (int i = 0; i < 24; ++i) {
    const int row = static_cast<int>(random() % static_cast<unsigned>(grid.rows));
    const int column = static_cast<int>(random() % static_cast<unsigned>(grid.columns));
    const auto exact =
        evaluate(spectrum, equirect_direction({(column + 0.5) / grid.columns, (row + 0.5) / grid.rows}));
    for (int c = 0; c < 3; ++c) {
      error += std::pow(grid.at(row, column)[c] - exact[c], 2);
      truth += exact[c] * exact[c];
    }
  }
  return std::sqrt(error / truth);
}

constexpr int lanes = 96;
WELKIN_TARGET_CLONES void multiply_add(double* values, int rounds) {
  double a[lanes];
  for (int i = 0; i < lanes; ++i) a[i] = values[i];
  for (int r = 0; r < rounds; ++r)
    for (int i = 0; i < lanes; ++i) a[i] = __builtin_fma(a[i], 0.999, 0.001);
  for (int i = 0; i < lanes; ++i) values[i] = a[i];
}

double peak_gigaflops() {
  constexpr int chunks = 64, rounds = 100000;
  std::vector<double> sums(chunks);
  const bench::Timing time = bench::measure(3, [&] {
    parallel_for(chunks, 1, [&](std::size_t begin, std::size_t) {
      double values[lanes] = {};
      multiply_add(values, rounds);
      sums[begin] = values[0];
    });
  });
  return 2.0 * chunks * rounds * lanes / time.best / 1e9;
}

double copy_gigabytes() {  // read plus write, GB/s
  const std::vector<float> from(1 << 25, 1.0f);
  std::vector<float> to(from.size());
  const bench::Timing time = bench::measure(3, [&] { std::memcpy(to.data(), from.data(), from.size() * 4); });
  return 8e-9 * static_cast<double>(from.size()) / time.best;
}

void bench_degree(bench::Report& report, int height, int degree, double peak) {
  const Image map = noise(2 * height, height);
  const double coefficients = 0.5 * (degree + 1) * (degree + 2);
  const auto rate = [&](double pairs, double seconds) {
    const double g = 15 * coefficients * pairs / seconds / 1e9;
    return fmt::format("{:.1f} Gflop/s, {:.0f} % of peak", g, 100 * g / peak);
  };
  Spectrum spectrum;
  const bench::Timing analysis = bench::measure(3, [&] { spectrum = analyze(map, {degree, 1e-5}); });
  report.figure(fmt::format("analyze {} x {} to degree {}", map.width, map.height, degree), analysis,
                analysis_error(map, spectrum), 2e-5, rate(height / 2.0, analysis.best));
  const int rows = (degree + 4) / 4 * 4;
  SphereGrid grid;
  const bench::Timing synthesis = bench::measure(3, [&] { grid = synthesize(spectrum, rows, 2 * rows); });
  report.figure(fmt::format("synthesize degree {} on {} x {}", degree, 2 * rows, rows), synthesis,
                synthesis_error(spectrum, grid), 2e-6, rate(rows / 2.0, synthesis.best));
}

}  // namespace

int main() try {
  bench::Report report;
  const double peak = peak_gigaflops();
  report.note(
      fmt::format("{} threads: multiply-add in registers {:.1f} Gflop/s (double), copy in memory {:.1f} GB/s "
                  "(one thread)",
                  thread_count(), peak, copy_gigabytes()));
  for (int degree : {127, 255, 511}) bench_degree(report, 256, degree, peak);
  for (int degree : {127, 255, 511, 1023}) bench_degree(report, 512, degree, peak);
  for (int degree : {255, 511, 1023}) bench_degree(report, 1024, degree, peak);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_transform: {}\n", error.what());
  return 1;
}
