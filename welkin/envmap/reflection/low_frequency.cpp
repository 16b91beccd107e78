#include <welkin/envmap/reflection/low_frequency.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <welkin/envmap/reflection/brdf_spectrum.h>
#include <welkin/envmap/reflection/shrm_orders.h>
#include <welkin/error.h>
#include <welkin/sh/rotation.h>
#include <welkin/sh/transform.h>

// With c_lq the light's real coefficients in the frame (x towards the view, z the normal), and
//   f cos+ = sum over l of [ t_l0 Y_l0 + sum_(q>0) sqrt2 t_lq Y_lq ]
// at the view's elevation (brdf_spectrum.h, Y_lq = sqrt2 P_lq cos(q phi')), the integral of the product is the dot
// product
//   B = sum over l of [ t_l0 c_l0 + sum_(q>0) sqrt2 t_lq c_lq ].
// What the light has above max_degree is lost, and only that: A_l sum over q of k_q t_lq^2 of each such degree
// (shrm_orders.h).

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check(const Image& radiance, const LowFrequencyOptions& options) {
  if (radiance.channels != 3 || radiance.empty())
    throw Error("low-frequency light needs an environment of 3 channels");
  if (options.max_degree < 0 || options.max_degree > 10)
    throw Error("the degree of low-frequency light must be in 0 .. 10");
  if (options.views < 4 || options.views > 4096)
    throw Error("the table of a BRDF takes 4 .. 4096 view elevations");
  if (!(options.smallest_cos_view >= 0 && options.smallest_cos_view < 0.9))
    throw Error("the smallest cosine of the view must be in [0, 0.9)");
}

std::vector<double> make_table(const IsotropicBrdf& brdf, int degree, int views) {
  std::vector<double> cosines;
  for (int i = 0; i < views; ++i) cosines.push_back(std::cos((i + 0.5) * pi / (2 * views)));
  const BrdfSpectrum spectrum = make_brdf_spectrum(brdf, ReflectionFrame::normal, degree, degree, cosines);
  std::vector<double> table(views * sh_count(degree) * 3);
  for (int i = 0; i < views; ++i)
    for (int l = 0; l <= degree; ++l)
      for (int q = 0; q <= l; ++q)
        for (int c = 0; c < 3; ++c)
          table[(i * sh_count(degree) + sh_index(l, q)) * 3 + c] =
              (q > 0 ? std::numbers::sqrt2 : 1) * spectrum.at(l, q, spectrum.channels == 1 ? 0 : c)[i];
  return table;
}

double predict_error(const Image& radiance, const IsotropicBrdf& brdf, const LowFrequencyOptions& options) {
  const ViewNodes nodes = make_view_nodes(48);
  const int degree = brdf_degree(brdf.angular_width, 192);
  const BrdfSpectrum reference =
      make_brdf_spectrum(brdf, ReflectionFrame::reflected, degree, degree, nodes.cos_view);
  const auto power = mean_coefficient_power(analyze(radiance, {.max_degree = degree}));
  const OrderErrors errors = order_errors(power, reference, reference, expand_views(reference, nodes, 0, 0),
                                          nodes, options.smallest_cos_view);
  double lost = errors.beyond_table;
  for (int l = options.max_degree + 1; l <= degree; ++l) lost += errors.dropped[l];
  return errors.signal > 0 ? std::sqrt(lost / errors.signal) : 0;
}

// Four-point Lagrange weights at x in units of the table's step; returns the first of the four.
int table_stencil(double x, int views, std::array<double, 4>& weights) {
  const int first = std::clamp(static_cast<int>(std::floor(x)) - 1, 0, views - 4);
  for (int i = 0; i < 4; ++i) {
    weights[i] = 1;
    for (int j = 0; j < 4; ++j)
      if (j != i) weights[i] *= (x - first - j) / (i - j);
  }
  return first;
}

// Rows: towards the view along the surface, the third axis, the normal.
Mat3 view_frame(Vec3 normal, Vec3 view) {
  Vec3 along = view - dot(normal, view) * normal;
  if (dot(along, along) < 1e-20)  // from straight above any direction serves
    along = std::abs(normal.x) < 0.7 ? cross(normal, {1, 0, 0}) : cross(normal, {0, 1, 0});
  along = along - dot(normal, along) * normal;
  along = normalized(along);
  return {{along, cross(normal, along), normal}};
}

}  // namespace

LowFrequencyReflection prepare_low_frequency(const Image& radiance, const IsotropicBrdf& brdf,
                                             const LowFrequencyOptions& options) {
  check(radiance, options);
  LowFrequencyReflection result;
  result.brdf = brdf.name;
  result.views = options.views;
  const auto start = Clock::now();
  result.light = project_equirect(radiance, options.max_degree);
  result.report.light_seconds = seconds_since(start);
  const auto brdf_start = Clock::now();
  result.table = make_table(brdf, options.max_degree, options.views);
  result.report.brdf_seconds = seconds_since(brdf_start);
  const auto error_start = Clock::now();
  result.report.predicted_error = predict_error(radiance, brdf, options);
  result.report.error_seconds = seconds_since(error_start);
  return result;
}

std::array<double, 3> reflect(const LowFrequencyReflection& reflection, const ReflectionQuery& query) {
  const double cos_view = dot(query.normal, query.view);
  if (!(cos_view > 0)) return {};
  const ShCoefficients light = rotate(reflection.light, view_frame(query.normal, query.view));
  const double theta = std::acos(std::min(1.0, cos_view));
  std::array<double, 4> weights;
  const int first = table_stencil(theta * 2 * reflection.views / pi - 0.5, reflection.views, weights);
  const std::size_t count = light.values.size();
  std::array<double, 3> sum{};
  for (int i = 0; i < 4; ++i) {
    const double* row = &reflection.table[(first + i) * count];
    for (std::size_t k = 0; k < count; ++k) sum[k % 3] += weights[i] * row[k] * light.values[k];
  }
  return sum;
}

}  // namespace welkin
