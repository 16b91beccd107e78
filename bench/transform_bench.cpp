#include <complex>
#include <ctime>
#include <numbers>
#include <random>

#include "measure.h"

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/parallel/simd.h>
#include <welkin/parallel/target_clones.h>
#include <welkin/sampling/quadrature.h>
#include <welkin/sh/transform.h>
#include <welkin/sh/transform_legendre.h>
#include <welkin/sphere/equirect.h>

// The fast spherical-harmonic transform on maps of white noise, which has no gentle degrees. Analysis is compared with
// patch integrals in long double, synthesis with the sum over all functions. The yardsticks are multiply-adds in registers
// and a triad in memory.

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

// The coefficients a_lm of red, l = m .. max_degree, by 12 Gauss nodes a row and exact azimuth integrals.
std::vector<std::complex<Wide>> oracle_order(const Image& map, int m, int max_degree) {
  std::vector<std::complex<Wide>> sums(max_degree - m + 1);
  std::vector<Wide> column(sums.size());
  const QuadratureRule rule = gauss_legendre(12);
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

// Chains of multiply-adds in the widest registers: twelve of 512 bits, enough for two units of four cycles' latency;
// compilers split them where registers are narrower.
using Wide8 = double __attribute__((vector_size(64)));
constexpr int chains = 12;
WELKIN_TARGET_CLONES void multiply_add(double* values, int rounds) {
  const Wide8 factor = Wide8{} + 0.999, term = Wide8{} + values[0];
  // All different, or compilers see that one chain is enough.
  Wide8 a0 = term, a1 = a0 + 1, a2 = a0 + 2, a3 = a0 + 3, a4 = a0 + 4, a5 = a0 + 5, a6 = a0 + 6, a7 = a0 + 7,
        a8 = a0 + 8, a9 = a0 + 9, a10 = a0 + 10, a11 = a0 + 11;
  for (int r = 0; r < rounds; ++r) {
    a0 = a0 * factor + term;
    a1 = a1 * factor + term;
    a2 = a2 * factor + term;
    a3 = a3 * factor + term;
    a4 = a4 * factor + term;
    a5 = a5 * factor + term;
    a6 = a6 * factor + term;
    a7 = a7 * factor + term;
    a8 = a8 * factor + term;
    a9 = a9 * factor + term;
    a10 = a10 * factor + term;
    a11 = a11 * factor + term;
  }
  const Wide8 sum = ((a0 + a1) + (a2 + a3)) + ((a4 + a5) + (a6 + a7)) + ((a8 + a9) + (a10 + a11));
  for (int i = 0; i < 8; ++i) values[i] = sum[i];
}

// Processor seconds, which other programs on the machine do not add to.
template <class Work>
bench::Timing measure_processor(int runs, Work&& work) {
  const auto now = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  work();
  std::vector<double> seconds(runs);
  for (double& s : seconds) {
    const double start = now();
    work();
    s = now() - start;
  }
  return bench::timing_of(seconds);
}

// Of one thread.
double peak_gigaflops() {
  constexpr int chunks = 8, rounds = 200000;
  std::vector<double> sums(chunks);
  const bench::Timing time = measure_processor(5, [&] {
    for (double& sum : sums) {
      double values[8] = {0.001};
      multiply_add(values, rounds);
      sum = values[0];
    }
  });
  return 2.0 * chunks * rounds * chains * 8 / time.best / 1e9;
}

// Triad of STREAM (McCalpin 1995) on all threads: two reads and a write, GB/s.
double stream_gigabytes() {
  constexpr std::size_t count = 1 << 24, chunk = 1 << 16;
  std::vector<double> a(count, 1.0), b(count, 2.0), c(count);
  const bench::Timing time = bench::measure(3, [&] {
    parallel_for(count, chunk, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) c[i] = a[i] + 3 * b[i];
    });
  });
  return 24e-9 * static_cast<double>(count) / time.best;
}

void bench_degree(bench::Report& report, int height, int degree, double stream) {
  const Image map = noise(2 * height, height);
  const auto bandwidth = [&](double numbers, double seconds) {
    return fmt::format("map or grid at {:.0f} % of a triad", 100 * 4e-9 * numbers / seconds / stream);
  };
  Spectrum spectrum;
  const bench::Timing analysis = bench::measure(5, [&] { spectrum = analyze(map, {degree}); });
  report.figure(fmt::format("analyze {} x {} to degree {}", map.width, map.height, degree), analysis,
                analysis_error(map, spectrum), 1e-8,
                bandwidth(static_cast<double>(map.pixels.size()), analysis.best));
  const int rows = (degree + 4) / 4 * 4;
  SphereGrid grid;
  const bench::Timing synthesis = bench::measure(5, [&] { grid = synthesize(spectrum, rows, 2 * rows); });
  report.figure(fmt::format("synthesize degree {} on {} x {}", degree, 2 * rows, rows), synthesis,
                synthesis_error(spectrum, grid), 2e-6,
                bandwidth(static_cast<double>(grid.values.size()), synthesis.best));
}

// The Legendre sums alone, three channels, one thread. Operations are those really done.
void bench_kernel(bench::Report& report, int degree, double peak) {
  const legendre::RowPairs rows(degree + 1);
  legendre::OrderData data(degree, rows, 6);
  Spectrum spectrum(degree, 3);
  std::mt19937 random(5);
  for (auto& value : spectrum.values)
    value = {1e-9 * static_cast<double>(random()), 1e-9 * static_cast<double>(random())};
  double done = 0;
  const auto all_orders = [&](auto&& work) {
    done = 0;
    for (int m = 0; m <= degree; ++m) done += 2.0 * static_cast<double>(work(m));
  };
  const auto numbers = [](Spectrum& s, int m) {
    return reinterpret_cast<double*>(&s.values[s.index(m, m) * 3]);
  };
  const auto rate = [&](double operations, double seconds) {
    return fmt::format("{:.1f} Gflop/s, {:.0f} % of peak", 1e-9 * operations / seconds,
                       100e-9 * operations / seconds / peak);
  };
  const auto synthesize_all = [&](int m) {
    return legendre::synthesize_order(m, rows, numbers(spectrum, m), data);
  };
  const bench::Timing synthesis = measure_processor(5, [&] { all_orders(synthesize_all); });
  report.note(fmt::format("  sums of synthesis, degree {:<5} {}", degree, rate(done, synthesis.best)));
  Spectrum back(degree, 3);
  const auto analyze_all = [&](int m) { return legendre::analyze_order(m, rows, data, numbers(back, m)); };
  const bench::Timing analysis = measure_processor(5, [&] { all_orders(analyze_all); });
  report.note(fmt::format("  sums of analysis, degree {:<6} {}", degree, rate(done, analysis.best)));
}

}  // namespace

int main() try {
  bench::Report report;
  const double peak = peak_gigaflops(), stream = stream_gigabytes();
  report.note(fmt::format(
      "{} threads, {}: multiply-add in registers {:.1f} Gflop/s (double, one thread), triad {:.1f} GB/s",
      thread_count(), simd_targets().front(), peak, stream));
  for (int degree : {127, 255, 511}) bench_degree(report, 256, degree, stream);
  for (int degree : {127, 255, 511, 1023}) bench_degree(report, 512, degree, stream);
  for (int degree : {255, 511, 1023}) bench_degree(report, 1024, degree, stream);
  for (int degree : {255, 511, 1023}) bench_kernel(report, degree, peak);
  for (const std::string& target : simd_targets()) {
    choose_simd_target(target);
    report.note("-- " + target);
    bench_degree(report, 512, 511, stream);
    bench_kernel(report, 511, peak);
  }
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_transform: {}\n", error.what());
  return 1;
}
