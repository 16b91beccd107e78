// Direct light of environments on glossy spheres: multiple importance sampling against product sampling, at equal time.
// bench_product [MAP...]: RMSE x sqrt(time), each method over MIS of BRDF and environment.

#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include <welkin/envmap/environment.h>
#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/pathtrace/product_sampling.h>
#include <welkin/raytrace/ray_scene.h>
#include <welkin/raytrace/surface.h>
#include <welkin/sampling/sobol.h>
#include <welkin/scene/built_in.h>

#include "measure.h"

namespace {

using namespace welkin;

struct Point {
  Surface surface;
  LocalFrame frame;
  Vec3f view;
  const Scatter* scatter;
};

struct Stage {
  Scene scene;
  std::vector<Scatter> scatters;
  const RayScene* rays = nullptr;
  const EnvironmentSampler* environment = nullptr;
  const ProductSampler* product = nullptr;

  bool free(const Point& p, Vec3f direction) const {
    return !rays->occluded({leave_surface(p.surface, direction), 0, direction, 1e30f});
  }
};

Scatter scatter_of(const Material& m) {
  Scatter s;
  s.model = m.model == MaterialModel::ggx ? ScatterModel::ggx : ScatterModel::coated_diffuse;
  s.color = m.base_color;
  s.compensated = true;
  s.alpha_x = s.alpha_y = m.perceptual_roughness * m.perceptual_roughness;
  return s;
}

Rgb by_mis(const Stage& stage, const Point& p, SampleStream& numbers) {
  Rgb sum;
  const auto power = [](float a, float b) { return a * a / (a * a + b * b); };
  const Vec2f u = numbers.next_2d();
  const ScatterSample s = sample(*p.scatter, p.view, u, numbers.next_1d());
  if (!is_black(s.weight)) {
    const Vec3f direction = p.frame.to_world(s.light);
    const EnvironmentSample e = stage.environment->at(direction);
    if (stage.free(p, direction)) sum += power(s.pdf, e.pdf) * (s.weight * e.radiance);
  }
  const EnvironmentSample e = stage.environment->sample(numbers.next_2d());
  const Vec3f light = p.frame.to_local(e.direction);
  if (light.z > 0) {
    const ScatterValue f = evaluate_with_pdf(*p.scatter, light, p.view);
    if (!is_black(f.value) && stage.free(p, e.direction))
      sum += (power(e.pdf, f.pdf) / e.pdf) * (f.value * e.radiance);
  }
  return sum;
}

Rgb by_product(const Stage& stage, const Point& p, SampleStream& numbers) {
  const Vec2f u = numbers.next_2d(), rest = numbers.next_2d();
  const ScatterSample s = sample(*p.scatter, p.view, u, rest.x);
  const Vec3f along = p.frame.to_world(s.light);
  float density = 0;
  const ProductSample kept =
      stage.product->sample(*p.scatter, p.frame, p.view, numbers.next_2d(), rest.y, along, density);
  Rgb sum;
  if (!is_black(kept.light) && stage.free(p, kept.direction)) sum += kept.light;
  if (!is_black(s.weight) && stage.free(p, along))
    sum += (s.pdf / (s.pdf + density)) * (s.weight * stage.environment->radiance(along));
  return sum;
}

using Method = std::function<Rgb(const Stage&, const Point&, SampleStream&)>;

constexpr int side = 32, runs = 4, samples = 16;  // pixels of a sphere; independent pictures; samples a pixel

std::optional<Point> first_hit(const Stage& stage, int sphere, int x, int y, Vec2f jitter) {
  const Sphere& s = stage.scene.spheres[sphere];
  const float px = (2 * (static_cast<float>(x) + jitter.x) / side - 1) * s.radius;
  const float py = (2 * (static_cast<float>(y) + jitter.y) / side - 1) * s.radius;
  const Ray ray{{s.centre.x + px, s.centre.y - py, 10}, 0, {0, 0, -1}, 1e30f};
  const std::optional<Hit> hit = stage.rays->closest(ray);
  if (!hit) return {};
  Point p{surface_at(*stage.rays, *hit, ray), {}, {}, &stage.scatters[sphere]};
  p.frame = p.surface.shading;
  p.view = p.frame.to_local({0, 0, 1});
  if (!(p.view.z > 0)) return {};
  return p;
}

struct Outcome {
  double mean = 0, rmse = 0, seconds = 0;
};

// The variance of a pixel of `samples` samples over independent pictures is its mean square error: no method is biased.
Outcome render(const Stage& stage, int sphere, const Method& method) {
  Outcome result;
  double variance = 0;
  std::vector<std::array<double, runs>> pixels(side * side);
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    seconds.push_back(bench::seconds_of([&] {
      for (int i = 0; i < side * side; ++i) {
        Rgb sum;
        for (int k = 0; k < samples; ++k) {
          SampleStream numbers(static_cast<std::uint32_t>(k),
                               mix_bits32(static_cast<std::uint32_t>(i + 9176 * run)));
          const auto point = first_hit(stage, sphere, i % side, i / side, numbers.next_2d());
          if (point) sum += method(stage, *point, numbers);
        }
        pixels[i][run] = luminance(sum) / samples;
      }
    }));
  }
  for (const auto& values : pixels) {
    double mean = 0, square = 0;
    for (double v : values) mean += v / runs;
    for (double v : values) square += (v - mean) * (v - mean) / (runs - 1);
    result.mean += mean / static_cast<double>(pixels.size());
    variance += square / static_cast<double>(pixels.size());
  }
  result.rmse = std::sqrt(variance);
  result.seconds = bench::timing_of(seconds).best;
  return result;
}

}  // namespace

int main(int count, char** names) {
  bench::Report report;
  std::vector<std::string> maps(names + 1, names + count);
  if (maps.empty()) maps = {"sky:daylight"};
  std::vector<std::pair<std::string, Method>> methods;
  methods.emplace_back("mis", by_mis);
  std::vector<ProductOptions> shares{{2}, {3}, {4}};
  for (const ProductOptions& o : shares)
    methods.emplace_back(fmt::format("product {}", o.candidates), by_product);
  Stage stage;
  stage.scene = make_built_in_scene("spheres:alphas=0.1/0.2/0.3/0.4");
  for (const Material& m : stage.scene.materials) stage.scatters.push_back(scatter_of(m));
  const RayScene rays(stage.scene);
  stage.rays = &rays;
  const int spheres = static_cast<int>(stage.scene.spheres.size());
  const double total = spheres * static_cast<double>(maps.size());
  std::vector<double> relative(methods.size()), slower(methods.size()), noise(methods.size());
  for (const std::string& name : maps) {
    const EnvironmentSampler sampler(load_environment(name, {}).radiance);
    stage.environment = &sampler;
    std::vector<ProductSampler> products;
    products.emplace_back(sampler);
    for (const ProductOptions& o : shares) products.emplace_back(sampler, o);
    for (int sphere = 0; sphere < spheres; ++sphere) {
      std::string line =
          fmt::format("{:<24} {}", name.substr(name.rfind('/') + 1), stage.scene.materials[sphere].name);
      Outcome mis;
      for (std::size_t m = 0; m < methods.size(); ++m) {
        stage.product = &products[m];
        const Outcome outcome = render(stage, sphere, methods[m].second);
        if (m == 0) mis = outcome;
        const double ratio = outcome.rmse / mis.rmse * std::sqrt(outcome.seconds / mis.seconds);
        relative[m] += ratio / total;
        noise[m] += outcome.rmse / mis.rmse / total;
        slower[m] += outcome.seconds / mis.seconds / total;
        line += m == 0 ? fmt::format("  mean {:.4g} rmse {:.3g} {:.0f} ns", mis.mean, mis.rmse,
                                     mis.seconds * 1e9 / (side * side * samples))
                       : fmt::format("  {:.3f}/{:.3f} ({:+.1f} %)", ratio, outcome.rmse / mis.rmse,
                                     100 * (outcome.mean / mis.mean - 1));
      }
      report.note(line);
    }
  }
  for (std::size_t m = 0; m < methods.size(); ++m)
    report.note(fmt::format("{:<10} RMSE at equal time {:.3f} of MIS, at equal samples {:.3f}, time {:.3f}",
                            methods[m].first, relative[m], noise[m], slower[m]));
  return report.exit_code();
}
