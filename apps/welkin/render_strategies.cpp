#include "render_strategies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include <welkin/error.h>
#include <welkin/pathtrace/camera_ray.h>

#include "json_text.h"
#include "picture.h"

namespace welkin {
namespace {

struct Strategy {
  const char *name, *title;
  LightSampling sampling;
};
constexpr Strategy strategies[] = {{"bsdf", "BRDF", LightSampling::bsdf},
                                   {"light", "environment", LightSampling::light},
                                   {"mis", "both, MIS", LightSampling::mis},
                                   {"product", "product, MIS", LightSampling::product}};
constexpr std::uint32_t converged_factor = 32;

// For each pixel the material that its centre shows, -1 for none; then only materials that are seen, numbered anew.
struct Regions {
  std::vector<int> material_of_pixel;
  std::vector<std::string> names;
};

int material_of(const Scene& scene, const Hit& hit) {
  if (hit.object < scene.instances.size())
    return scene.meshes[static_cast<std::size_t>(scene.instances[hit.object].mesh)].material;
  return scene.spheres[hit.object - scene.instances.size()].material;
}

Regions find_regions(const RenderJob& job) {
  const RayScene rays(job.scene);
  const PictureSize size = job.options.size;
  const CameraRays camera(job.camera, size);
  Regions regions;
  std::vector<int> number(job.scene.materials.size(), -1);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const auto hit = rays.closest(camera.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
      regions.material_of_pixel.push_back(hit ? material_of(job.scene, *hit) : -1);
      if (hit) number[static_cast<std::size_t>(regions.material_of_pixel.back())] = 0;
    }
  for (std::size_t m = 0; m < number.size(); ++m) {
    if (number[m] < 0) continue;
    number[m] = static_cast<int>(regions.names.size());
    const std::string& name = job.scene.materials[m].name;
    regions.names.push_back(name.empty() ? fmt::format("material {}", m) : name);
  }
  for (int& material : regions.material_of_pixel)
    if (material >= 0) material = number[static_cast<std::size_t>(material)];
  if (regions.names.empty())
    throw Error(job.scene.source, "shows no surface to the camera: nothing can be compared");
  return regions;
}

double luminance_at(const Image& image, std::size_t pixel) {
  const float* p = &image.pixels[3 * pixel];
  return 0.2126 * double{p[0]} + 0.7152 * double{p[1]} + 0.0722 * double{p[2]};
}

// The converged picture's own variance is a part of every mean square: taken out, as far as it is known.
std::vector<StrategyError> errors_of(const Image& radiance, const PictureLayers& converged,
                                     const Regions& regions) {
  struct Sums {
    double squares = 0, luminance = 0, count = 0;
  };
  std::vector<Sums> sums(regions.names.size());
  for (std::size_t i = 0; i < regions.material_of_pixel.size(); ++i) {
    if (regions.material_of_pixel[i] < 0) continue;
    Sums& sum = sums[static_cast<std::size_t>(regions.material_of_pixel[i])];
    const double truth = luminance_at(converged.radiance, i), own = luminance_at(converged.standard_error, i);
    sum.squares += std::pow(luminance_at(radiance, i) - truth, 2) - own * own;
    sum.luminance += truth;
    sum.count += 1;
  }
  std::vector<StrategyError> errors;
  for (const Sums& sum : sums) {
    const double mean = sum.luminance / sum.count;
    errors.push_back({mean > 0 ? std::sqrt(std::max(0.0, sum.squares / sum.count)) / mean : 0});
  }
  return errors;
}

// Processor time, not the clock's: other programs take their share of that.
double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Renderer {
  const RenderJob& job;
  const RenderScene& scene;
  const StrategyObserver& observer;

  std::optional<PictureState> render(const std::string& what, LightSampling sampling, std::uint32_t samples,
                                     std::uint32_t seed) const {
    PictureOptions options = job.options;
    options.samples = samples;
    options.target_error = 0;
    options.integrator.integrator = Integrator::direct;
    options.integrator.sampling = sampling;
    options.integrator.seed = seed;
    PictureState state = make_picture_state(options.size);
    const bool done = render_picture(state, scene, job.camera, options, [&](const PictureProgress& progress) {
      return observer(what, progress.share);
    });
    return done ? std::optional(std::move(state)) : std::nullopt;
  }
  std::optional<StrategyRun> run(const Strategy& strategy, std::uint32_t samples, std::uint32_t seed) const {
    const double start = processor_seconds();
    const auto state = render(fmt::format("sampling {}", strategy.name), strategy.sampling, samples, seed);
    if (!state) return std::nullopt;
    return StrategyRun{strategy.name, samples, processor_seconds() - start, {}, picture_radiance(*state)};
  }
};

std::uint32_t samples_in_time(const StrategyRun& run, double seconds) {
  const double samples = run.samples * seconds / std::max(run.seconds, 1e-6);
  return static_cast<std::uint32_t>(std::clamp(std::round(samples), 1.0, 1e6));
}

nlohmann::ordered_json runs_json(const std::vector<StrategyRun>& runs,
                                 const std::vector<std::string>& materials) {
  auto list = nlohmann::ordered_json::array();
  for (const StrategyRun& run : runs) {
    nlohmann::ordered_json errors;
    for (std::size_t m = 0; m < materials.size(); ++m) errors[materials[m]] = run.errors[m].relative_rmse;
    list.push_back({{"sampling", run.name},
                    {"samples", run.samples},
                    {"processor_seconds", run.seconds},
                    {"relative_rmse", errors}});
  }
  return list;
}

void print_runs(const std::string& title, const std::vector<StrategyRun>& runs,
                const std::vector<std::string>& materials) {
  fmt::print("\n{:<20}", title);
  for (const StrategyRun& run : runs) fmt::print(" {:>9}", run.name);
  fmt::print("\n{:<20}", "samples a pixel");
  for (const StrategyRun& run : runs) fmt::print(" {:>9}", run.samples);
  fmt::print("\n{:<20}", "processor seconds");
  for (const StrategyRun& run : runs) fmt::print(" {:>9.2f}", run.seconds);
  fmt::print("\n");
  for (std::size_t m = 0; m < materials.size(); ++m) {
    fmt::print("{:<20}", materials[m]);
    for (const StrategyRun& run : runs) fmt::print(" {:>9.4f}", run.errors[m].relative_rmse);
    fmt::print("\n");
  }
}

}  // namespace

std::optional<StrategyComparison> compare_strategies(const RenderJob& job, const StrategyObserver& observer) {
  const Regions regions = find_regions(job);
  const RenderScene scene(job.scene, job.environment ? &*job.environment : nullptr);
  const Renderer renderer{job, scene, observer};
  const std::uint32_t samples = job.options.samples, seed = job.options.integrator.seed;
  StrategyComparison result;
  result.materials = regions.names;
  for (const Strategy& strategy : strategies) {
    auto run = renderer.run(strategy, samples, seed);
    if (!run) return std::nullopt;
    result.equal_samples.push_back(std::move(*run));
  }
  for (std::size_t i = 0; i < std::size(strategies); ++i) {
    const std::uint32_t affordable =
        samples_in_time(result.equal_samples[i], result.equal_samples[2].seconds);
    auto run = renderer.run(strategies[i], affordable, seed + 1);
    if (!run) return std::nullopt;
    result.equal_time.push_back(std::move(*run));
  }
  result.converged_samples = converged_factor * samples;
  const auto converged =
      renderer.render("converging", LightSampling::mis, result.converged_samples, seed + 2);
  if (!converged) return std::nullopt;
  result.converged = make_picture_layers(*converged);
  for (auto* runs : {&result.equal_samples, &result.equal_time})
    for (StrategyRun& run : *runs) run.errors = errors_of(run.radiance, result.converged, regions);
  return result;
}

std::string strategy_json(const StrategyComparison& comparison) {
  return json_text({{"quantity", "RMSE of luminance over its mean, pixels of a material; direct light"},
                    {"converged_samples", comparison.converged_samples},
                    {"equal_samples", runs_json(comparison.equal_samples, comparison.materials)},
                    {"equal_time", runs_json(comparison.equal_time, comparison.materials)}}) +
         "\n";
}

void print_strategies(const StrategyComparison& comparison) {
  fmt::print("relative RMSE of luminance against {} samples a pixel, direct light\n",
             comparison.converged_samples);
  print_runs("equal samples", comparison.equal_samples, comparison.materials);
  print_runs("equal time", comparison.equal_time, comparison.materials);
}

ByteImage strategy_sheet(const StrategyComparison& comparison, const ToneMapOptions& tone) {
  constexpr int margin = 6, caption = text_height + 2 * margin;
  const Image& converged = comparison.converged.radiance;
  ToneMapOptions options = tone;
  if (!options.exposure_ev) options.exposure_ev = automatic_exposure_ev(converged);
  const int strips = static_cast<int>(comparison.equal_samples.size()) + 1;
  ByteImage sheet(converged.width + 2 * margin, strips * (converged.height + caption) + margin, 3);
  for (int i = 0; i < strips; ++i) {
    const bool last = i + 1 == strips;
    const int y = i * (converged.height + caption);
    const Image& radiance = last ? converged : comparison.equal_samples[static_cast<std::size_t>(i)].radiance;
    const std::string text = last
                                 ? fmt::format("converged, {} samples", comparison.converged_samples)
                                 : fmt::format("{}, {} samples", strategies[i].title,
                                               comparison.equal_samples[static_cast<std::size_t>(i)].samples);
    draw_text(sheet, margin, y + margin, 1, text, {230, 230, 230});
    blit(tone_map(radiance, options), sheet, margin, y + caption);
  }
  return sheet;
}

}  // namespace welkin
