#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "measure.h"

#include <welkin/brdf/models.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/error.h>
#include <welkin/sphere/resample.h>

// The split sum and stretched taps against the brute-force integral of the GGX BRDF, over all view angles.
// Errors are mean |error| over mean truth, over n.v uniform in [0.02, 1] (cos) and over a sphere's pixels (ball). The
// maps are gray (their luminance), so that the three channels can be
// three values of F0. FILE arguments replace the built-in maps.

namespace {

using namespace welkin;

constexpr int map_width = 128;  // brute force sums over every texel
constexpr int query_count = 150;
constexpr std::array<double, 3> f0 = {0.04, 0.5, 1};

using PerF0 = std::array<double, 3>;

struct Errors {
  PerF0 mean{}, rms{};
};

template <class Surface>
Errors errors_of(const Surface& surface, const std::vector<ReflectionQuery>& queries,
                 const std::vector<double>& truth) {
  Errors errors;
  PerF0 total{}, square{};
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const std::array<double, 3> rgb = reflect(surface, queries[i]);
    for (int c = 0; c < 3; ++c) {
      const double t = truth[3 * i + c], e = rgb[c] - t;
      errors.mean[c] += std::abs(e);
      errors.rms[c] += e * e;
      total[c] += t;
      square[c] += t * t;
    }
  }
  for (int c = 0; c < 3; ++c) {
    errors.mean[c] /= total[c];
    errors.rms[c] = std::sqrt(errors.rms[c] / square[c]);
  }
  return errors;
}

std::vector<ReflectionQuery> ball(int size) {
  std::vector<ReflectionQuery> queries = sphere_picture_queries(size);
  std::erase_if(queries, [](const ReflectionQuery& q) { return length(q.normal) == 0; });
  return queries;
}

Image gray(const Image& source) {
  Image map = cube_to_equirect(equirect_to_cube(source, map_width / 4), map_width, map_width / 2);
  for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
    float* p = &map.pixels[i];
    p[0] = p[1] = p[2] = 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
  }
  return map;
}

// Sums over maps, for the last table.
struct Total {
  Errors plain, taps;
  int count = 0;
};

void add(Errors& sum, const Errors& e) {
  for (int c = 0; c < 3; ++c) {
    sum.mean[c] += e.mean[c];
    sum.rms[c] += e.rms[c];
  }
}

std::string compared(const Errors& plain, const Errors& taps, double scale) {
  std::string text;
  for (int c = 0; c < 3; ++c)
    text += fmt::format("  {:6.2f} {:6.2f} {:5.1f}x |{:6.2f} {:6.2f}", 100 * scale * plain.mean[c],
                        100 * scale * taps.mean[c], plain.mean[c] / taps.mean[c], 100 * scale * plain.rms[c],
                        100 * scale * taps.rms[c]);
  return text;
}

void bench_map(bench::Report& report, const std::string& source, const StretchedTapsTable& table,
               std::array<Total, 10>& totals) {
  const Image map = gray(load_environment(source).radiance);
  const PrefilteredChain chain = make_prefiltered_chain(map);
  report.note("-- " + source);
  int slot = 0;
  for (const auto& queries : {random_reflection_queries(query_count, 11, 0.02), ball(14)})
    for (double r : {0.3, 0.4, 0.5, 0.6, 0.7}) {
      const std::vector<double> truth = reflect_brute_force(map, make_ggx_brdf(r * r, f0), queries);
      const Errors plain = errors_of(SplitSum{chain, f0, r * r}, queries, truth);
      const Errors taps = errors_of(StretchedTaps{chain, table, f0, r * r}, queries, truth);
      report.note(fmt::format("{} r {:.1f} {}", slot < 5 ? "cos " : "ball", r, compared(plain, taps, 1)));
      Total& total = totals[slot++];
      add(total.plain, plain);
      add(total.taps, taps);
      ++total.count;
    }
}

}  // namespace

int main(int argc, char** argv) {
  bench::Report report;
  StretchedTapsTable table;
  const auto time = bench::measure(1, [&] { table = make_stretched_taps_table(ChainShape{}); });
  report.note(fmt::format("table {:.2f} s", time.best));
  std::array<Total, 10> totals;
  std::vector<std::string> sources(argv + 1, argv + argc);
  if (sources.empty()) sources = {"sky:day,elevation=30", "sky:studio"};
  for (const std::string& s : sources) bench_map(report, s, table, totals);
  report.note(
      "all: F0 = 0.04, 0.5, 1: mean of the split sum, of stretched taps, ratio | RMS of both, per cent");
  double worst = 0;
  for (int i = 0; i < 10; ++i)
    report.note(fmt::format("{} r {:.1f} {}", i < 5 ? "cos " : "ball", 0.3 + 0.1 * (i % 5),
                            compared(totals[i].plain, totals[i].taps, 1.0 / totals[i].count)));
  for (const Total& total : totals)
    for (int c = 0; c < 3; ++c) worst = std::max(worst, total.taps.mean[c] / total.plain.mean[c]);
  report.check("stretched taps over split sum, worst row", worst, 0.7);
  return report.exit_code();
}
