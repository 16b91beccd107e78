#include "brdf_sampling.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <vector>

#include <welkin/brdf/scatter/sampling_check.h>
#include <welkin/brdf/scatter/scatter_spec.h>
#include <welkin/sampling/sobol.h>

#include "json_text.h"

namespace welkin {
namespace {

constexpr float azimuth = 0.7f;  // of the views, oblique to both tangents

Vec3f view_at(float cosine) {
  const float s = std::sqrt(1 - cosine * cosine);
  return {s * std::cos(azimuth), s * std::sin(azimuth), cosine};
}

struct Times {
  double sample = 0, evaluate = 0;  // ns
};

// The best of ten runs over 4096 random pairs.
Times times_of(const Scatter& scatter) {
  std::vector<Vec3f> directions;
  for (std::uint32_t i = 0; i < 8192; ++i) {
    const Vec2f u = SampleStream(i, 1).next_2d();
    const float z = 0.05f + 0.95f * u.x, s = std::sqrt(1 - z * z), phi = 6.2831853f * u.y;
    directions.push_back({s * std::cos(phi), s * std::sin(phi), z});
  }
  volatile float sink = 0;
  const auto best_of = [&](auto call) {
    double best = INFINITY;
    for (int run = 0; run < 10; ++run) {
      const auto start = std::chrono::steady_clock::now();
      float sum = 0;
      for (std::size_t i = 0; i < 4096; ++i) sum += call(directions[i], directions[4096 + i]);
      sink = sum;
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return 1e9 * best / 4096;
  };
  return {best_of([&](Vec3f view, Vec3f any) {
            return sample(scatter, view, {std::abs(any.x), std::abs(any.y)}, any.z < 1 ? any.z : 0).weight.r;
          }),
          best_of([&](Vec3f view, Vec3f light) { return evaluate_with_pdf(scatter, light, view).pdf; })};
}

struct View {
  float cosine = 1;
  SamplingCheck check;
  Rgb approximate;
};

nlohmann::ordered_json triple(Rgb c) { return nlohmann::ordered_json::array({c.r, c.g, c.b}); }

void print_json(const std::string& spec, const std::vector<View>& views, Times times) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const View& v : views)
    rows.push_back({{"cos_view", v.cosine},
                    {"albedo_by_quadrature", triple(v.check.quadrature_albedo)},
                    {"albedo_by_sampling", triple(v.check.sampled_albedo)},
                    {"standard_error", triple(v.check.standard_error)},
                    {"approximate_albedo", triple(v.approximate)},
                    {"relative_std", v.check.relative_std},
                    {"largest_weight", v.check.largest_weight},
                    {"pdf_integral", v.check.pdf_integral},
                    {"kept", v.check.kept},
                    {"delta", v.check.delta},
                    {"chi_square_p", v.check.p}});
  fmt::print("{}\n", json_text({{"brdf", spec},
                                {"sample_ns", times.sample},
                                {"evaluate_with_pdf_ns", times.evaluate},
                                {"views", rows}}));
}

void print_text(const std::string& spec, const std::vector<View>& views, Times times, int samples) {
  fmt::print("{}, {} samples a view\n", spec, samples);
  fmt::print("  sample {:.0f} ns, evaluate_with_pdf {:.0f} ns\n", times.sample, times.evaluate);
  fmt::print(
      "cos view  albedo by quadrature        by sampling                 error    rel. std  largest  kept    "
      "mirror  p\n");
  for (const View& v : views) {
    const Rgb q = v.check.quadrature_albedo, s = v.check.sampled_albedo;
    fmt::print(
        "{:>8.2f}  {:<8.5f} {:<8.5f} {:<8.5f}  {:<8.5f} {:<8.5f} {:<8.5f}  {:<8.5f} {:>7.3f} {:>8.2f}  "
        "{:<7.5f} {:<7.5f} {:.3f}\n",
        v.cosine, q.r, q.g, q.b, s.r, s.g, s.b, max_channel(v.check.standard_error), v.check.relative_std,
        v.check.largest_weight, v.check.kept, v.check.delta, v.check.p);
  }
}

}  // namespace

void print_brdf_sampling(const std::string& spec, int samples, bool json) {
  const OwnedScatter owned = parse_scatter(spec);
  std::vector<View> views;
  for (const float cosine : {1.0f, 0.9f, 0.7f, 0.5f, 0.3f, 0.2f, 0.1f}) {
    const Vec3f view = view_at(cosine);
    views.push_back({cosine, check_sampling(owned.scatter, view, {.samples = samples}),
                     approximate_albedo(owned.scatter, view)});
  }
  const Times times = times_of(owned.scatter);
  json ? print_json(spec, views, times) : print_text(spec, views, times, samples);
}

}  // namespace welkin
