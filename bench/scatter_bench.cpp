#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <welkin/brdf/scatter/sampling_check.h>
#include <welkin/brdf/scatter/scatter_spec.h>
#include <welkin/sampling/sobol.h>

#include "measure.h"

// BRDFs for Monte Carlo: time of sample, evaluate, evaluate_with_pdf and approximate_albedo; beside it whether samples
// follow their density (chi-square), the mean weight against quadrature, and the noise in a white furnace. Optional
// arguments: SPECs as of `welkin brdf`. The yardstick is Lambert of the same run.

using namespace welkin;

namespace {

struct Query {
  Vec3f view, light;
  Vec2f u;
  float lobe = 0;
};

std::vector<Query> make_queries() {
  std::vector<Query> queries;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    SampleStream stream(i, 1);
    const auto direction = [](Vec2f u) {
      const float z = 0.05f + 0.95f * u.x, s = std::sqrt(1 - z * z);
      return Vec3f{s * std::cos(6.2831853f * u.y), s * std::sin(6.2831853f * u.y), z};
    };
    const Vec3f view = direction(stream.next_2d()), light = direction(stream.next_2d());
    const Vec2f u = stream.next_2d();
    queries.push_back({view, light, u, stream.next_1d()});
  }
  return queries;
}

// Best of several runs, ns a call; all queries differ, so branches are as hard to guess as in a renderer.
template <class Call>
double nanoseconds(const std::vector<Query>& queries, Call call) {
  float sink = 0;
  const bench::Timing time = bench::measure(25, [&] {
    for (const Query& q : queries) sink += call(q);
  });
  if (sink == 0.12345f) fmt::print("\n");
  return 1e9 * time.best / static_cast<double>(queries.size());
}

struct Times {
  double sample = 0, value = 0, both = 0, albedo = 0;
};

Times times_of(const Scatter& s, const std::vector<Query>& queries) {
  Times t;
  t.sample = nanoseconds(queries, [&](const Query& q) { return sample(s, q.view, q.u, q.lobe).weight.r; });
  t.value = nanoseconds(queries, [&](const Query& q) { return evaluate(s, q.light, q.view).r; });
  t.both = nanoseconds(queries, [&](const Query& q) { return evaluate_with_pdf(s, q.light, q.view).pdf; });
  t.albedo = nanoseconds(queries, [&](const Query& q) { return approximate_albedo(s, q.view).r; });
  return t;
}

// p of the chi-square test must not be absurd, and the mean weight within 5 standard errors of quadrature.
void report_model(bench::Report& report, const std::string& spec, const std::vector<Query>& queries,
                  double lambert) {
  const OwnedScatter owned = parse_scatter(spec);
  const SamplingCheck check = check_sampling(owned.scatter, {0.64f, 0.48f, 0.6f}, {.samples = 1 << 18});
  const Times t = times_of(owned.scatter, queries);
  report.note(fmt::format(
      "{:<44} {:>6.0f} {:>8.0f} {:>8.0f} {:>7.0f} {:>7.1f}x {:>9.3f} {:>7.2f} {:>8.4f} {:>8.4f} {:>7.3f}",
      spec, t.sample, t.value, t.both, t.albedo, t.sample / lambert, check.relative_std, check.largest_weight,
      check.sampled_albedo.g, check.quadrature_albedo.g, check.p));
  if (check.delta > 0) return;
  const double off = std::abs(check.sampled_albedo.g - check.quadrature_albedo.g);
  const bool good = check.p > 1e-4 && off < 5 * check.standard_error.g + 1e-3;
  if (!good) report.check(spec + ": samples against quadrature", off, 0);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> specs(argv + 1, argv + argc);
  if (specs.empty())
    specs = {"lambert:0.5",
             "oren-nayar:0.5,0.5",
             "phong:100",
             "phong:100,1,compensated",
             "blinn-phong:100",
             "lafortune:-0.9:-0.6:1:8",
             "ggx:0.25,1",
             "ggx:0.25,1,compensated",
             "ggx:0.1:0.5,1",
             "ggx:0.1:0.5,1,compensated",
             "ggx-conductor:0.25,0.2:0.9:1.2,3.9:2.4:2.2",
             "ggx-conductor:0.25,0.2:0.9:1.2,3.9:2.4:2.2,compensated",
             "mirror",
             "conductor:0.2:0.9:1.2,3.9:2.4:2.2",
             "dielectric:1.5",
             "coated-diffuse:0.25,0.8",
             "coated-diffuse:0,0.8",
             "metallic-roughness:0.25,0.8:0.4:0.2,0",
             "metallic-roughness:0.25,0.8:0.4:0.2,0.5",
             "metallic-roughness:0.25,0.8:0.4:0.2,0,compensated",
             "metallic-roughness:0.25,0.8:0.4:0.2,1,compensated"};
  bench::Report report;
  const std::vector<Query> queries = make_queries();
  ggx_energy_table();
  const double lambert = times_of(parse_scatter("lambert:0.5").scatter, queries).sample;
  report.note("times in ns, best of 25 runs over 4096 queries; the rest at cos view 0.6, 262144 samples");
  report.note(fmt::format("{:<44} {:>6} {:>8} {:>8} {:>7} {:>8} {:>9} {:>7} {:>8} {:>8} {:>7}", "BRDF",
                          "sample", "evaluate", "with pdf", "albedo", "lambert", "rel. std", "largest",
                          "sampled", "exact", "p"));
  for (const std::string& spec : specs) report_model(report, spec, queries, lambert);
  return report.exit_code();
}
