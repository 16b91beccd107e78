#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <welkin/envmap/environment.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>
#include <welkin/pathtrace/integrator.h>
#include <welkin/sampling/sobol.h>
#include <welkin/scene/built_in.h>

// How honest a pixel's standard error is, and what that costs: samples of a pixel dealt to 1, 4, 8, 16 or 32 sequences
// that are scrambled independently; the error told by the spread of their means, or, for one sequence, by s^2/n. Against
// a converged picture.
// Usage: bench_picture_error [FILE ...]     environments in place of a built-in sky

namespace welkin {
namespace {

constexpr PictureSize size{112, 32};
constexpr std::size_t pixels = std::size_t{112} * 32;

struct Sums {
  double sum = 0, squares = 0;
};

// The mean and the variance of the mean, by the spread of replicates, or by s^2/n where there is one.
struct Estimate {
  double mean = 0, variance = 0;
};

struct Setting {
  std::string name;
  const RenderScene& scene;
  const Camera& camera;
};

double sample(const Setting& setting, std::size_t pixel, std::uint32_t index, std::uint32_t seed) {
  IntegratorOptions options;
  options.integrator = Integrator::direct;
  options.seed = seed;
  const auto width = static_cast<std::size_t>(size.width);
  return double{luminance(render_sample(setting.scene, setting.camera, size, static_cast<int>(pixel % width),
                                        static_cast<int>(pixel / width), index, options)
                              .radiance)};
}

Estimate estimate(const Setting& setting, std::size_t pixel, std::uint32_t samples, std::uint32_t replicates,
                  std::uint32_t seed) {
  std::array<Sums, 32> sums{};
  double total = 0, squares = 0;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const std::uint32_t r = i % replicates;
    const double value = sample(setting, pixel, i / replicates, mix_bits32(seed * 64 + r));
    sums[r].sum += value;
    total += value;
    squares += value * value;
  }
  const double n = samples, mean = total / n;
  if (replicates == 1) return {mean, (squares / n - mean * mean) / (n - 1)};
  double spread = 0;
  for (std::uint32_t r = 0; r < replicates; ++r) spread += std::pow(sums[r].sum / (n / replicates) - mean, 2);
  return {mean, spread / replicates / (replicates - 1)};
}

// Ratio of the stated to the true error, both root mean squares over pixels relative to the pixel; shares of pixels whose
// error is beyond two stated ones.
void measure(const Setting& setting, std::uint32_t samples, std::uint32_t replicates,
             const std::vector<double>& truth, double& yardstick) {
  std::vector<Estimate> estimates(pixels);
  parallel_for(pixels, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) estimates[i] = estimate(setting, i, samples, replicates, 5);
  });
  double stated = 0, error = 0, beyond = 0, count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!(truth[i] > 0)) continue;
    const double difference = estimates[i].mean - truth[i];
    stated += estimates[i].variance / (truth[i] * truth[i]);
    error += difference * difference / (truth[i] * truth[i]);
    beyond += difference * difference > 4 * estimates[i].variance;
    count += 1;
  }
  const double rmse = std::sqrt(error / count);
  if (replicates == 1) yardstick = rmse;
  std::printf("%-28s %7u %10u %12.5f %9.3f %14.3f %13.2f\n", setting.name.c_str(), samples, replicates, rmse,
              rmse / yardstick, std::sqrt(stated / error), 100 * beyond / count);
}

void run(const std::string& map) {
  const Environment environment = load_environment(map);
  const EnvironmentSampler sampler(environment.radiance);
  const Scene built = make_built_in_scene("spheres");
  const RenderScene scene(built, &sampler);
  const std::size_t slash = map.rfind('/');
  const Setting setting{slash == std::string::npos ? map : map.substr(slash + 1), scene,
                        built.cameras.front()};
  std::vector<double> truth(pixels);
  parallel_for(pixels, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) truth[i] = estimate(setting, i, 8192, 1, 99).mean;
  });
  for (const std::uint32_t samples : {64u, 256u}) {
    double yardstick = 1;
    for (const std::uint32_t replicates : {1u, 4u, 8u, 16u, 32u})
      measure(setting, samples, replicates, truth, yardstick);
  }
}

}  // namespace
}  // namespace welkin

int main(int argc, char** argv) try {
  std::printf("%-28s %7s %10s %12s %9s %14s %13s\n", "environment", "samples", "replicates", "relative RMSE",
              "to one", "stated / true", "beyond 2, %%");
  for (int i = 1; i < argc; ++i) welkin::run(argv[i]);
  if (argc == 1) welkin::run("sky:studio,size=256x128");
} catch (const welkin::Error& error) {
  std::fprintf(stderr, "bench_picture_error: %s\n", error.what());
  return 1;
}
