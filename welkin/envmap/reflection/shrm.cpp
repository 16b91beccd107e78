#include <welkin/envmap/reflection/shrm.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include <welkin/envmap/reflection/shrm_orders.h>
#include <welkin/error.h>
#include <welkin/sh/basis.h>
#include <welkin/sh/transform.h>

// Derivation. Let the local frame of a query have its pole at d, the normal or the view mirrored about it, and
// c_lq(d) be the light's coefficients there (spin_synthesis.h). With the view at (theta_v, phi_v) of that frame and
// t_lq the coefficients of f cos+ over the light, for a view of azimuth 0 (brdf_spectrum.h), orthonormality gives
//   B(d, v) = sum over l of [ c_l0 t_l0 + 2 Re sum_(q>0) c_lq t_lq exp(i q phi_v) ].
// t_lq depends on the view's polar angle; expanded as sum over p of rho_lpq P_pq(cos theta_v) it gives
//   B(d, v) = sum over p of [ B_p0 P_p0 + 2 Re sum_(q>0) B_pq(d) P_pq exp(i q phi_v) ],
//   B_pq(d) = sum over l of rho_lpq c_lq(d):
// each B_pq is a spin synthesis of the light's spectrum with the factors rho_lpq (as in Ramamoorthi & Hanrahan 2002,
// with their representation matrices folded into c_lq). In the frame of the reflected direction theta_v = 2
// theta_o fills the sphere, and a lobe around the pole has small q only: few maps at a high degree. About the
// normal every q up to l is there, which pays for low degrees only.

namespace welkin {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr int reference_limit = 192;  // degrees of the tables and of the light's spectrum
constexpr int normal_limit = 32;      // degrees that the view's nodes resolve about the normal
constexpr int view_nodes = 48;  // Gauss-Legendre: P_pq P_p'q are integrated exactly up to order 16 and beyond

void check(const Image& radiance, const ShrmOptions& options) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw Error(what);
  };
  require(radiance.channels == 3 && !radiance.empty(), "a reflection map needs an environment of 3 channels");
  require(options.error_bound > 0 && std::isfinite(options.error_bound), "the error bound must be above 0");
  require(options.max_degree >= 0 && options.max_degree <= max_spin_degree,
          "the largest degree must be in 0 .. 128");
  require(options.max_order >= 0 && options.max_order <= 16,
          "the largest order of the view must be in 0 .. 16");
  require(!options.degree || (*options.degree >= 0 && *options.degree <= options.max_degree),
          "the degree must be in 0 .. the largest degree");
  require(!options.order || (*options.order >= 0 && *options.order <= options.max_order),
          "the order of the view must be in 0 .. its largest");
  require(options.smallest_cos_view >= 0 && options.smallest_cos_view < 0.9,
          "the smallest cosine of the view must be in [0, 0.9)");
}

// One frame's table, expansion and errors.
struct Candidate {
  ViewExpansion expansion;
  OrderErrors errors;
  ReflectionFrame frame = ReflectionFrame::reflected;
};

struct Choice {
  const Candidate* candidate = nullptr;
  int degree = 0, order = 0;
  double error = 0, cost = 0;
};

// Calls visit(choice) for everything that the options allow. The cost is the number of values kept.
template <class Visit>
void for_each_choice(const std::vector<Candidate>& candidates, const ShrmOptions& options, Visit&& visit) {
  for (const Candidate& candidate : candidates) {
    const int last_order =
        std::min(static_cast<int>(candidate.errors.kept.size()) - 1, options.order.value_or(1000));
    const int last_degree = std::min(candidate.expansion.max_degree, options.degree.value_or(1000));
    for (int order = options.order.value_or(0); order <= last_order; ++order) {
      const auto maps = static_cast<double>(view_terms(candidate.frame, order).size());
      for (int degree = options.degree.value_or(0); degree <= last_degree; ++degree)
        visit(Choice{&candidate, degree, order, candidate.errors.relative_error(degree, order),
                     maps * (degree + 1.0) * (degree + 1.0)});
    }
  }
}

// The cheapest choice within the bound; where none is, the cheapest within 5 % of the smallest error.
Choice choose(const std::vector<Candidate>& candidates, const ShrmOptions& options) {
  double smallest = INFINITY;
  for_each_choice(candidates, options, [&](const Choice& c) { smallest = std::min(smallest, c.error); });
  const double bound = std::max(options.error_bound, 1.05 * smallest);
  Choice best;
  for_each_choice(candidates, options, [&](const Choice& c) {
    if (c.error <= bound && (best.candidate == nullptr || c.cost < best.cost)) best = c;
  });
  return best;
}

std::vector<SpinFilter> filters_of(const ViewExpansion& expansion, int degree, int order) {
  std::vector<SpinFilter> filters;
  for (std::size_t k = 0; k < expansion.terms.size(); ++k) {
    if (expansion.terms[k].p > order) continue;
    SpinFilter filter{expansion.terms[k].q, {}};
    for (int l = 0; l <= degree; ++l)
      for (int c = 0; c < 3; ++c)
        filter.factors.push_back(expansion.at(k, l, expansion.channels == 1 ? 0 : c));
    filters.push_back(std::move(filter));
  }
  return filters;
}

Spectrum truncated(const Spectrum& spectrum, int degree) {
  return convolve(spectrum, std::vector<double>(degree + 1, 1.0));
}

// Rows for which interpolation errs by 3e-3 of the highest degree and by much less below it; no large prime factors.
int grid_rows(int degree) {
  const auto smooth = [](int n) {
    for (const int p : {2, 3, 5})
      for (; n % p == 0; n /= p) {
      }
    return n == 1;
  };
  int rows = std::max(16, 3 * (degree + 1));
  while (rows % 2 != 0 || !smooth(rows)) ++rows;
  return rows;
}

std::vector<Candidate> make_candidates(const IsotropicBrdf& brdf, const Spectrum& spectrum,
                                       const ShrmOptions& options) {
  const ViewNodes nodes = make_view_nodes(view_nodes);
  const int degree = spectrum.max_degree;
  const BrdfSpectrum reference =
      make_brdf_spectrum(brdf, ReflectionFrame::reflected, degree, degree, nodes.cos_view);
  const auto power = mean_coefficient_power(spectrum);
  std::vector<Candidate> candidates;
  const auto add = [&](const BrdfSpectrum& table, int limit) {
    Candidate candidate;
    candidate.frame = table.frame;
    candidate.expansion = expand_views(table, nodes, std::min({degree, options.max_degree, limit}),
                                       std::min(options.max_order, table.max_order));
    candidate.errors =
        order_errors(power, reference, table, candidate.expansion, nodes, options.smallest_cos_view);
    candidates.push_back(std::move(candidate));
  };
  if (options.frame != ReflectionFrame::normal) add(reference, degree);
  if (options.frame != ReflectionFrame::reflected) {
    const int limit = std::min(degree, normal_limit);
    add(make_brdf_spectrum(brdf, ReflectionFrame::normal, limit, limit, nodes.cos_view), limit);
  }
  return candidates;
}

}  // namespace

ReflectionMap prepare_shrm(const Image& radiance, const IsotropicBrdf& brdf, const ShrmOptions& options) {
  check(radiance, options);
  ReflectionMap map{brdf.name, {}, {}};
  ShrmReport& report = map.report;
  const auto start = Clock::now();
  const Spectrum spectrum =
      analyze(radiance, {.max_degree = brdf_degree(brdf.angular_width, reference_limit)});
  report.analysis_seconds = seconds_since(start);

  const auto brdf_start = Clock::now();
  const std::vector<Candidate> candidates = make_candidates(brdf, spectrum, options);
  const Choice choice = choose(candidates, options);
  if (choice.candidate == nullptr) throw Error("the degree is above what the BRDF " + brdf.name + " has");
  report.brdf_seconds = seconds_since(brdf_start);
  report.frame = choice.candidate->frame;
  report.degree = choice.degree;
  report.order = choice.order;
  report.predicted_error = choice.error;
  report.bound_met = report.predicted_error <= options.error_bound;

  const auto synthesis_start = Clock::now();
  const auto filters = filters_of(choice.candidate->expansion, choice.degree, choice.order);
  report.rows = grid_rows(choice.degree);
  report.columns = 2 * report.rows;
  map.coefficients =
      synthesize_spin(truncated(spectrum, choice.degree), filters, report.rows, report.columns);
  report.maps = static_cast<int>(map.coefficients.slot_spin.size());
  report.synthesis_seconds = seconds_since(synthesis_start);
  return map;
}

std::array<double, 3> reflect(const ReflectionMap& map, const ReflectionQuery& query) {
  const double cos_view = dot(query.normal, query.view);
  if (!(cos_view > 0)) return {};
  const ShrmReport& report = map.report;
  const bool about_normal = report.frame == ReflectionFrame::normal;
  const Vec3 axis = about_normal ? query.normal : normalized(2 * cos_view * query.normal - query.view);
  std::vector<float> coefficients(map.coefficients.stride());
  interpolate(map.coefficients, axis, coefficients);

  // 2 Re B_pq P_pq exp(i q phi) = sqrt2 (Re B_pq Y_pq - Im B_pq Y_p-q) with the real basis Y of basis.h.
  std::vector<double> basis(sh_count(report.order));
  evaluate_sh_basis(normalized(spin_frame(axis) * query.view), report.order, basis);
  std::array<double, 3> sum{};
  const float* value = coefficients.data();
  const auto add = [&](double weight) {
    for (int c = 0; c < 3; ++c) sum[c] += weight * *value++;
  };
  for (const auto [p, q] : view_terms(report.frame, report.order)) {
    add(q > 0 ? std::numbers::sqrt2 * basis[sh_index(p, q)] : basis[sh_index(p, 0)]);
    if (q > 0) add(-std::numbers::sqrt2 * basis[sh_index(p, -q)]);
  }
  return sum;
}

}  // namespace welkin
