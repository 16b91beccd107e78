#include "measure.h"
#include "reflection_figure.h"

#include <welkin/brdf/brdf_spec.h>
#include <welkin/brdf/lafortune.h>
#include <welkin/envmap/environment.h>
#include <welkin/envmap/reflection/lafortune_stack.h>
#include <welkin/envmap/reflection/lobe_stack.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

// View-dependent reflections against the full integral, over random normals and views (cosine of the view uniform in
// [0.05, 1]): what each method costs to prepare and how far off it is. Usage: bench_reflection [FILE ...]

namespace {

using namespace welkin;

constexpr int query_count = 100, runs = 1;

struct Scene {
  std::string name;
  Image map;
  std::vector<ReflectionQuery> queries;
};

void print(bench::Report& report, const std::string& what, bench::Timing time,
           const bench::ReflectionError& error, double limit) {
  report.figure(
      what, time, error.relative_rms, limit,
      fmt::format("mean {:.1e}, largest/mean {:.1e}; RMS by cos view: {:.1e} {:.1e} {:.1e}", error.mean,
                  error.largest, error.by_angle[0], error.by_angle[1], error.by_angle[2]));
}

void bench_lafortune(bench::Report& report, const Scene& scene) {
  LafortuneStack stack;
  const bench::Timing time = bench::measure(runs, [&] { stack = prepare_lafortune_stack(scene.map); });
  const auto queries = with_tangents(scene.queries);
  for (const char* text :
       {"-1:-1:1:1", "-1:-1:1:8", "-1:-1:1:64", "-1:-1:1:100", "-1:-1:1:1000", "-1:-1:0.7:64",
        "-1:-0.6:0.9:64", "-0.95:-0.6:1:30:0.5,0.7:0.7:0.9:6:0.3,diffuse:0.2"}) {
    const LafortuneBrdf brdf = parse_lafortune(text);
    const auto truth = reflect_lafortune_brute_force(scene.map, brdf, queries);
    std::size_t at = 0;
    const auto error = bench::reflection_error(
        scene.queries, truth, [&](const ReflectionQuery&) { return reflect(stack, brdf, queries[at++]); });
    print(report, fmt::format("lafortune {}", text), time, error, 1);
  }
}

struct LobeRow {
  std::string name;
  bool single = false;
  LobeStackOptions options;
};

void bench_lobes(bench::Report& report, const Scene& scene) {
  const std::vector<LobeRow> rows = {{"single lobe", true, {}},
                                     {"1 lobe", false, {}},
                                     {"2 lobes", false, {.lobes = 2}},
                                     {"1 lobe ggx", false, {.family = LobeFamily::ggx}},
                                     {"1 lobe phong", false, {.family = LobeFamily::phong}},
                                     {"1 lobe, cosine outside", false, {.target = LobeTarget::brdf}}};
  for (const char* spec : {"ggx:0.25,1", "ggx:0.5,1", "ward:0.2"}) {
    const IsotropicBrdf brdf = parse_brdf(spec);
    std::vector<double> truth;
    const double brute =
        bench::seconds_of([&] { truth = reflect_brute_force(scene.map, brdf, scene.queries); });
    report.note(
        fmt::format("{}: the full integral takes {:.2f} ms a query", spec, 1000 * brute / query_count));
    for (const LobeRow& row : rows) {
      LobeStack stack;
      const double seconds = bench::seconds_of([&] {
        stack = row.single ? prepare_single_lobe(scene.map, brdf, row.options)
                           : prepare_lobe_stack(scene.map, brdf, row.options);
      });
      const auto error = bench::reflection_error(
          scene.queries, truth, [&](const ReflectionQuery& query) { return reflect(stack, query); });
      print(report, fmt::format("  {}", row.name), {seconds, seconds}, error, 1);
    }
  }
}

void bench_scene(bench::Report& report, const std::string& source) {
  const Scene scene{source, load_environment(source).radiance, random_reflection_queries(query_count, 1)};
  report.note(fmt::format("-- {} ({} x {}), {} queries, {} threads", source, scene.map.width,
                          scene.map.height, query_count, thread_count()));
  bench_lobes(report, scene);
  bench_lafortune(report, scene);
}

}  // namespace

int main(int argc, char** argv) try {
  bench::Report report;
  for (const char* sky : {"sky:day,size=128x64", "sky:studio,size=128x64"}) bench_scene(report, sky);
  for (int i = 1; i < argc; ++i) bench_scene(report, argv[i]);
  return report.exit_code();
} catch (const welkin::Error& error) {
  fmt::print(stderr, "bench_reflection: {}\n", error.what());
  return 1;
}
