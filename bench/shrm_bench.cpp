#include <ctime>
#include <string>
#include <vector>

#include <welkin/brdf/models.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/reflection/low_frequency.h>
#include <welkin/envmap/reflection/shrm.h>
#include <welkin/envmap/reflection/shrm_orders.h>
#include <welkin/sh/transform.h>

#include "measure.h"

// Reflection by spherical harmonics: predicted errors against measured ones, then the times of reflection maps.
//   bench_shrm [FILE ...]     environments, else the built-in ones

namespace {

using namespace welkin;
constexpr std::array<double, 3> white = {1, 1, 1};

std::string name_of(const ShrmReport& r) {
  return fmt::format("F {:>2} P {:>2} {} {:>3} maps{}", r.degree, r.order,
                     r.frame == ReflectionFrame::normal ? "N" : "R", r.maps, r.bound_met ? "" : " (not met)");
}

struct Truth {
  std::vector<ReflectionQuery> queries;
  std::vector<double> values;

  Truth(const Image& radiance, const IsotropicBrdf& brdf, int count)
      : queries(random_reflection_queries(count, 1)), values(reflect_brute_force(radiance, brdf, queries)) {}

  template <class Map>
  double error(const Map& map) const {
    double error = 0, signal = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const auto value = reflect(map, queries[i]);
      for (int c = 0; c < 3; ++c) {
        error += (value[c] - values[i * 3 + c]) * (value[c] - values[i * 3 + c]);
        signal += values[i * 3 + c] * values[i * 3 + c];
      }
    }
    return std::sqrt(error / signal);
  }
};

// Means of squares of texels, at most 128 wide: the truth costs queries times texels.
Image reduced(const Image& map) {
  int factor = 1;
  while (map.width / factor > 128 && map.width % (2 * factor) == 0 && map.height % (2 * factor) == 0)
    factor *= 2;
  Image result(map.width / factor, map.height / factor);
  const float share = 1.0f / static_cast<float>(factor * factor);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      for (int c = 0; c < 3; ++c) result.at(x / factor, y / factor)[c] += share * map.at(x, y)[c];
  return result;
}

// The larger of the ratio and its inverse.
double mismatch(double a, double b) { return std::max(a / b, b / a); }

void errors(bench::Report& report, const std::string& name, const Image& radiance) {
  report.note(fmt::format(
      "\n{}: relative RMS, predicted / measured at 300 normals and views; mismatch is their ratio", name));
  for (const auto& brdf : {make_phong_brdf(20), make_phong_brdf(80), make_ggx_brdf(0.25, {0.04, 0.5, 0.9}),
                           make_ggx_brdf(0.5, white), make_ward_brdf(0.2), make_ward_brdf(0.4)}) {
    const Truth truth(radiance, brdf, 300);
    for (const double bound : {0.1, 0.03}) {
      ShrmOptions options;
      options.error_bound = bound;
      const ReflectionMap map = prepare_shrm(radiance, brdf, options);
      const double measured = truth.error(map), predicted = map.report.predicted_error;
      report.check(fmt::format("{:<24.24} {:<26} {:.4f} / {:.4f}", brdf.name, name_of(map.report), predicted,
                               measured),
                   mismatch(predicted, measured), 1.5);
    }
    const auto low = prepare_low_frequency(radiance, brdf);
    const double measured = truth.error(low);
    report.check(fmt::format("{:<24.24} {:<26} {:.4f} / {:.4f}", brdf.name, "25 coefficients",
                             low.report.predicted_error, measured),
                 mismatch(low.report.predicted_error, measured), 1.5);
  }
}

void times(bench::Report& report, const Image& radiance, int degree) {
  const IsotropicBrdf brdf = make_ggx_brdf(0.1, white);
  ShrmOptions options;
  options.frame = ReflectionFrame::reflected;
  options.degree = degree;
  options.order = 10;
  std::vector<double> analysis, tables, synthesis, both, cpu;
  ReflectionMap map;
  for (int run = 0; run < 5; ++run) {
    map = prepare_shrm(radiance, brdf, options);
    analysis.push_back(map.report.analysis_seconds);
    tables.push_back(map.report.brdf_seconds);
    synthesis.push_back(map.report.synthesis_seconds);
    both.push_back(analysis.back() + synthesis.back());
    // The same work again, by the clock of the processors: what a quiet machine would take, times its threads.
    const Spectrum spectrum = analyze(radiance, {.max_degree = degree});
    std::vector<SpinFilter> filters;
    for (const ViewTerm& term : view_terms(ReflectionFrame::reflected, options.order.value()))
      filters.push_back({term.q, std::vector<double>(3 * (degree + 1), 0.5)});
    const std::clock_t start = std::clock();
    synthesize_spin(spectrum, filters, map.report.rows, map.report.columns);
    cpu.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  const auto line = [&](const char* what, std::vector<double> seconds) {
    const bench::Timing time = bench::timing_of(std::move(seconds));
    report.note(fmt::format("  {:<52} {:>7.0f} ms best {:>7.0f} ms median", what, 1000 * time.best,
                            1000 * time.median));
  };
  report.note(fmt::format("\nP 10, F {}: {} maps of {} x {} from {} x {}", degree, map.report.maps,
                          map.report.columns, map.report.rows, radiance.width, radiance.height));
  line("analysis of the environment, degree 80", analysis);
  line("coefficient maps", synthesis);
  line("prefilter: both (goal 500 ms)", both);
  line("coefficient maps, processor time of all threads", cpu);
  line("BRDF, once a material", tables);
  std::vector<float> source(map.coefficients.values), copy(source.size());
  const bench::Timing copied =
      bench::measure(5, [&] { std::copy(source.begin(), source.end(), copy.begin()); });
  report.note(fmt::format("  {:<52} {:>7.0f} ms best", "yardstick: copying the maps", 1000 * copied.best));
  const auto queries = random_reflection_queries(20000, 3);
  double sum = 0;
  const bench::Timing looked = bench::measure(3, [&] {
    for (const auto& query : queries) sum += reflect(map, query)[0];
  });
  report.note(fmt::format("  {:<52} {:>7.1f} us best{}", "one look-up, one thread", 1e6 * looked.best / 20000,
                          sum == 12345 ? " " : ""));
}

}  // namespace

int main(int argc, char** argv) {
  bench::Report report;
  const std::vector<std::string> files(argv + 1, argv + argc);
  const bool given = !files.empty();
  for (const std::string& name :
       given ? files : std::vector<std::string>{"sky:studio,size=128x64", "sky:day,size=128x64,sun=0"})
    errors(report, name, reduced(load_environment(name).radiance));
  const Image large = load_environment(given ? files.front() : "sky:day,size=2048x1024").radiance;
  for (const int degree : {30, 64}) times(report, large, degree);
  return report.exit_code();
}
