#include <welkin/sh/monte_carlo.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/sampling/sequence.h>

namespace welkin {
namespace {

constexpr double sphere_area = 4 * std::numbers::pi;
constexpr std::size_t grain = 4096, batch = 64 * grain;

// Archimedes: z and the azimuth of a uniform direction are independent and uniform.
Vec3 uniform_direction(Point2 point) {
  const double z = 1 - 2 * point[0], r = std::sqrt(std::max(0.0, 1 - z * z));
  const double phi = 2 * std::numbers::pi * point[1];
  return {r * std::cos(phi), r * std::sin(phi), z};
}

Point2 random_point(std::uint64_t index, std::uint64_t seed) {
  const std::uint64_t start = mix_bits(seed) + 2 * index;
  return {static_cast<double>(mix_bits(start) >> 11) * 0x1p-53,
          static_cast<double>(mix_bits(start + 1) >> 11) * 0x1p-53};
}

// Sums of L Y_lm and of its square over samples.
struct Moments {
  std::vector<double> sum, squares;

  explicit Moments(std::size_t count = 0) : sum(count), squares(count) {}

  void add(std::size_t i, double value) {
    sum[i] += value;
    squares[i] += value * value;
  }
  void add(const Moments& other) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += other.sum[i];
      squares[i] += other.squares[i];
    }
  }
};

// In batches, so that memory does not grow with the samples; chunks are added in the same order whatever their batch.
template <class Point>
Moments sample(const RadianceFunction& radiance, int channels, int max_degree, std::uint64_t count,
               Point&& point) {
  const std::size_t functions = sh_count(max_degree);
  Moments all(functions * channels);
  for (std::uint64_t first = 0; first < count; first += batch) {
    const auto batch_count = static_cast<std::size_t>(std::min<std::uint64_t>(batch, count - first));
    const auto partials = parallel_partials<Moments>(
        batch_count, grain, [&](Moments& moments, std::size_t begin, std::size_t end) {
          moments = Moments(functions * channels);
          std::vector<double> basis(functions), value(channels);
          for (std::size_t i = begin; i < end; ++i) {
            const Vec3 direction = uniform_direction(point(first + i));
            radiance(direction, value);
            evaluate_sh_basis(direction, max_degree, basis);
            for (std::size_t k = 0; k < functions; ++k)
              for (int c = 0; c < channels; ++c) moments.add(k * channels + c, basis[k] * value[c]);
          }
        });
    for (const Moments& moments : partials) all.add(moments);
  }
  return all;
}

// The mean of `count` independent values, scaled to the sphere, and the standard error of that mean.
MonteCarloProjection estimate(const Moments& moments, int channels, int max_degree, std::uint64_t count) {
  MonteCarloProjection result;
  result.coefficients = ShCoefficients(max_degree, channels);
  result.standard_errors.resize(moments.sum.size());
  const double n = static_cast<double>(count);
  for (std::size_t i = 0; i < moments.sum.size(); ++i) {
    const double mean = moments.sum[i] / n;
    const double variance = std::max(0.0, moments.squares[i] / n - mean * mean) * n / (n - 1);
    result.coefficients.values[i] = sphere_area * mean;
    result.standard_errors[i] = sphere_area * std::sqrt(variance / n);
  }
  return result;
}

MonteCarloProjection project_low_discrepancy(const RadianceFunction& radiance, int channels, int max_degree,
                                             const MonteCarloOptions& options) {
  const std::uint64_t per_run = (options.samples + low_discrepancy_runs - 1) / low_discrepancy_runs;
  Moments runs(sh_count(max_degree) * channels);
  for (std::uint64_t run = 0; run < low_discrepancy_runs; ++run) {
    const std::uint64_t seed = mix_bits(mix_bits(options.seed) + run) | 1;  // 0 would mean "not shifted"
    const Moments moments =
        sample(radiance, channels, max_degree, per_run, [&](std::uint64_t i) { return r2_point(i, seed); });
    for (std::size_t i = 0; i < moments.sum.size(); ++i)
      runs.add(i, moments.sum[i] / static_cast<double>(per_run));
  }
  MonteCarloProjection result = estimate(runs, channels, max_degree, low_discrepancy_runs);
  result.samples = per_run * low_discrepancy_runs;
  return result;
}

}  // namespace

MonteCarloProjection project_monte_carlo(const RadianceFunction& radiance, int channels, int max_degree,
                                         const MonteCarloOptions& options) {
  if (max_degree < 0 || max_degree > max_projection_degree)
    throw Error("the degree must be between 0 and " + std::to_string(max_projection_degree));
  if (channels < 1) throw Error("radiance needs at least one channel");
  if (options.samples < 2) throw Error("a Monte Carlo projection needs at least 2 samples");
  if (options.kind == SampleKind::low_discrepancy)
    return project_low_discrepancy(radiance, channels, max_degree, options);
  const Moments moments = sample(radiance, channels, max_degree, options.samples,
                                 [&](std::uint64_t i) { return random_point(i, options.seed); });
  MonteCarloProjection result = estimate(moments, channels, max_degree, options.samples);
  result.samples = options.samples;
  return result;
}

MonteCarloProjection project_monte_carlo(const SphereMap& radiance, int max_degree,
                                         const MonteCarloOptions& options) {
  const MapShape shape = radiance.shape();
  check_map_shape(shape);
  const auto texel = [&](Vec3 direction, std::span<double> out) {
    const MapPoint point = map_point(shape, direction);
    const int x = std::min(static_cast<int>(point.x), shape.width - 1);
    const int y = std::min(static_cast<int>(point.y), shape.height - 1);
    std::copy_n(radiance.image.at(x, y), out.size(), out.begin());
  };
  return project_monte_carlo(texel, radiance.image.channels, max_degree, options);
}

}  // namespace welkin
