#pragma once
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include <welkin/pathtrace/camera_ray.h>
#include <welkin/pathtrace/mis.h>
#include <welkin/pathtrace/render_scene.h>
#include <welkin/sampling/sobol.h>

// The path tracer as a template on what traces the rays: the library traces them in the scene's RayScene, the benchmark
// records them as well.
//
// Radiance that leaves x towards the viewer is L(x) = Le(x) + integral f L cos; the integral is estimated by one direction a
// surface. Light that arrives straight from an emitter (environment, emissive surface, punctual light) is estimated apart
// from light that is reflected there (next-event estimation), by two strategies at once: a direction towards a light, and
// the direction in which the path goes on; each is weighted by mis_weight. What the path meets on its way is therefore
// counted with the weight of the direction that led there: 1 for the camera's rays and for mirror directions, which no
// light sample can find.

namespace welkin {

/// Needs closest and occluded of batches, as RayScene has them, of Rays.
///
/// Up to 16 samples go on together, surface by surface: their rays are traced as a batch, which for those of one pixel is
/// half as fast again as one by one, and more for the camera's.
template <class Rays>
class PathTracer {
 public:
  PathTracer(const RenderScene::Tables& tables, const IntegratorOptions& options, Rays& rays)
      : tables_(tables), options_(options), rays_(rays) {
    bounces_ = options.integrator == Integrator::direct || !options.shadows ? 0 : std::max(options.max_bounces, 0);
    if (options.sampling == LightSampling::product && tables.environment != nullptr) {
      product_ = &tables.product();
      lights_ = &product_->others;
    }
  }

  /// One ray of the camera and the numbers of its sample in; radiance, albedo, normal, coverage and the position of the
  /// first surface, if any, out.
  struct Sample {
    SampleStream stream{0, 0};
    PixelSample* pixel = nullptr;
    Vec3f first;

    void begin(SampleNumber, const SampleStream& of_sample) { stream = of_sample; }
  };

  void trace(std::span<const Ray> camera_rays, Sample* samples) {
    assert(camera_rays.size() <= RayScene::batch_size);
    count_ = camera_rays.size();
    for (std::size_t i = 0; i < count_; ++i) {
      space_.rays_out[i] = camera_rays[i];
      space_.paths[i] = Path();
      space_.paths[i].sample = &samples[i];
    }
    for (int bounce = 0; count_ > 0; ++bounce) step(bounce);
  }

 private:
  struct Path {
    Sample* sample = nullptr;
    Rgb throughput{1, 1, 1};
    float pdf = std::numeric_limits<float>::infinity();  ///< of its ray; infinite for camera and mirrors
    Vec3f from;                                          ///< the surface that the ray left
    float product_density = 0;                           ///< of product sampling along the ray
  };
  /// Light that reaches a camera if nothing is in between.
  struct Candidate {
    Rgb light;
    Path* path = nullptr;
  };

  /// A surface that a path has met.
  struct Vertex {
    ShadingPoint point;
    Path* path = nullptr;
    Vec3f ray_direction;
    float lobe = 0;  ///< which of the BRDF's lobes goes on
  };

  /// What 16 samples need on their way: too large to be made anew each time, so every thread keeps one.
  struct Workspace {
    Path paths[RayScene::batch_size];
    Ray rays_out[RayScene::batch_size];  ///< the next ray of each
    Hit hits[RayScene::batch_size];
    Ray shadow_rays[2 * RayScene::batch_size];  ///< two a surface with product sampling
    Vertex vertices[RayScene::batch_size];
    Candidate candidates[2 * RayScene::batch_size];
    EnvironmentPlace places[RayScene::batch_size];  ///< of the rays that meet nothing
    LightQuery queries[RayScene::batch_size];       ///< of the vertices
    LightSample lights[RayScene::batch_size];       ///< picked for the vertices
    Vec2f directions[RayScene::batch_size];         ///< what picks the directions in which paths go on
  };
  static Workspace& workspace() {
    thread_local Workspace space;
    return space;
  }

  /// Takes all paths from their rays to the next. What waits for memory (surfaces, the environment's tables) is done for
  /// all paths in loops of its own, so that the waits overlap.
  void step(int bounce) {
    const RayKind kind = bounce == 0 ? RayKind::side_by_side : RayKind::scattered;
    const bool looks_past_all = bounce > 0 && !options_.shadows;
    const std::uint32_t met =
        looks_past_all ? 0 : rays_.closest(std::span<const Ray>(space_.rays_out, count_), space_.hits, kind);
    prefetch_surfaces(tables_.rays, met, space_.hits);
    add_environment(met, bounce);
    const std::size_t count = meet_surfaces(met, bounce);
    pick_lights(count);
    Path* reflected[RayScene::batch_size];
    std::size_t alive = 0;
    shadows_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
      Vertex& at = space_.vertices[i];
      prepare_shading(tables_.scene, tables_.materials, at.ray_direction, at.point);
      if (bounce == 0) describe(at.point, *at.path->sample);
      const Rgb light = direct_light(at.point, space_.lights[i], space_.shadow_rays[shadows_]);
      if (!is_black(light)) space_.candidates[shadows_++] = {at.path->throughput * light, at.path};
      if (go_on(*at.path, at.point, bounce, space_.directions[i], at.lobe, space_.rays_out[alive]))
        reflected[alive++] = at.path;
    }
    add_what_is_visible(bounce);
    for (std::size_t i = 0; i < alive; ++i) space_.paths[i] = *reflected[i];  // never to a later place
    count_ = alive;
  }

  void add_what_is_visible(int bounce) {
    for (std::size_t begin = 0; begin < shadows_; begin += RayScene::batch_size) {
      const std::size_t count = std::min(shadows_ - begin, RayScene::batch_size);
      const std::uint32_t hidden =
          options_.shadows ? rays_.occluded(std::span<const Ray>(space_.shadow_rays + begin, count)) : 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Candidate& candidate = space_.candidates[begin + i];
        if ((hidden >> i & 1) == 0) add(candidate.light, bounce, *candidate.path->sample);
      }
    }
  }

  /// Fills the vertices with what was met and goes on; returns how many.
  std::size_t meet_surfaces(std::uint32_t met, int bounce) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if ((met >> i & 1) == 0) continue;
      Vertex& at = space_.vertices[count];
      at.point.surface = surface_at(tables_.rays, space_.hits[i], space_.rays_out[i]);
      if (tables_.materials[at.point.surface.material].emits) {
        add_emission(space_.paths[i], bounce, space_.hits[i], at.point);
      }
      if (bounce > bounces_) continue;  // this ray only looked for light
      at.path = &space_.paths[i];
      at.ray_direction = space_.rays_out[i].direction;
      ++count;
    }
    return count;
  }

  void pick_lights(std::size_t count) {
    SampleStream* streams[RayScene::batch_size];
    Vec2f choices[RayScene::batch_size], u[RayScene::batch_size];
    for (std::size_t i = 0; i < count; ++i) streams[i] = &space_.vertices[i].path->sample->stream;
    const std::span<SampleStream* const> used(streams, count);
    next_2d(used, choices);
    next_2d(used, u);
    next_2d(used, space_.directions);
    for (std::size_t i = 0; i < count; ++i) {
      Vertex& at = space_.vertices[i];
      at.lobe = choices[i].y;
      space_.queries[i] = {at.point.surface.position, choices[i].x, u[i]};
    }
    if (options_.sampling != LightSampling::bsdf && !lights_->empty()) {
      lights_->sample(std::span<const LightQuery>(space_.queries, count), space_.lights);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {  // what has no size, no ray finds
      const LightQuery& query = space_.queries[i];
      space_.lights[i] =
          lights_->has_punctual_lights() ? lights_->sample_punctual(query.from, query.select) : LightSample();
    }
  }

  static void describe(const ShadingPoint& point, Sample& sample) {
    sample.first = point.surface.position;
    sample.pixel->coverage = 1;
    sample.pixel->normal = point.frame.normal;
    sample.pixel->albedo = approximate_albedo(*point.scatter, point.view);
  }

  static constexpr float delta_pdf = 3e38f;

  /// An indirect contribution (light that was reflected twice at least) is clamped where asked for.
  void add(Rgb light, int reflections_before, Sample& sample) const {
    if (options_.clamp_indirect > 0 && reflections_before > 0) {
      const float most = max_channel(light);
      if (most > options_.clamp_indirect) light = (options_.clamp_indirect / most) * light;
    }
    sample.pixel->radiance += light;
  }

  /// The share of what the path has met that is its own to count, where a light sample finds the same with light_pdf.
  float weight_of_path(const Path& path, float light_pdf) const {
    if (!(path.pdf < delta_pdf)) return 1;
    switch (options_.sampling) {
      case LightSampling::bsdf: return 1;
      case LightSampling::light: return 0;
      default: return mis_weight(options_.heuristic, path.pdf, light_pdf);
    }
  }

  /// For the paths that have met nothing.
  void add_environment(std::uint32_t met, int bounce) {
    if (tables_.environment == nullptr || (bounce == 0 && !options_.show_environment)) return;
    const EnvironmentSampler& environment = *tables_.environment;
    Vec3f directions[RayScene::batch_size];
    const Path* paths[RayScene::batch_size];
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if ((met >> i & 1) != 0) continue;
      directions[count] = space_.rays_out[i].direction;
      paths[count++] = &space_.paths[i];
    }
    environment.places({directions, count}, {space_.places, count});
    for (std::size_t i = 0; i < count; ++i) {
      const Path& path = *paths[i];
      const EnvironmentSample sky = environment.at(directions[i], space_.places[i]);
      add(weight_of_path_to_sky(path, sky.pdf) * path.throughput * sky.radiance, bounce - 1, *path.sample);
    }
  }

  float weight_of_path_to_sky(const Path& path, float sky_pdf) const {
    // Densities of one sample and of several candidates: the balance heuristic.
    if (product_ != nullptr && path.pdf < delta_pdf) return path.pdf / (path.pdf + path.product_density);
    return weight_of_path(path, tables_.lights.pdf_of_environment(sky_pdf));
  }

  void add_emission(const Path& path, int bounce, const Hit& hit, const ShadingPoint& point) const {
    const Surface& s = point.surface;
    const Rgb emission = tables_.lights.emission(s.material, s.front, s.texcoords);
    if (is_black(emission)) return;
    const float light_pdf = path.pdf < delta_pdf ? lights_->pdf_of_surface(path.from, hit, s) : 0.0f;
    add(weight_of_path(path, light_pdf) * path.throughput * emission, bounce - 1, *path.sample);
  }

  /// The ray that finds out whether the surface sees the light.
  static Ray shadow_ray(const Surface& surface, const LightSample& light) {
    Ray ray;
    ray.origin = leave_surface(surface, light.direction);
    ray.direction = light.direction;
    if (light.distance < 1e30f) {  // between two points that are both off their surfaces
      const Vec3f way = light.target - ray.origin;
      const float distance = length(way);
      if (distance > 0) ray.direction = (1 / distance) * way;
      ray.far = distance * (1 - 0x1p-20f);
    }
    return ray;
  }

  /// Without shadows a surface does not hide light from itself either.
  bool may_go(const ShadingPoint& point, Vec3f direction) const {
    return !options_.shadows || point.faces(direction);
  }

  /// What the surface reflects of one light that was picked, if `shadow` meets nothing.
  Rgb direct_light(const ShadingPoint& point, const LightSample& light, Ray& shadow) const {
    if (is_black(light.radiance) || !(light.pdf > 0) || !may_go(point, light.direction)) return {};
    if (!options_.shadows && (light.is_delta || light.distance < 1e30f)) return {};
    const Vec3f local = point.frame.to_local(light.direction);
    if (!(local.z > 0)) return {};
    const ScatterValue scattered = evaluate_with_pdf(*point.scatter, local, point.view);
    const bool shared = options_.sampling != LightSampling::light && !light.is_delta;
    const float weight = shared ? mis_weight(options_.heuristic, light.pdf, scattered.pdf) : 1.0f;
    shadow = shadow_ray(point.surface, light);
    return (weight / light.pdf) * scattered.value * light.radiance;
  }

  /// Takes the path's next direction. False where it ends here.
  bool go_on(Path& path, const ShadingPoint& point, int bounce, Vec2f u, float lobe, Ray& ray) {
    SampleStream& stream = path.sample->stream;
    const ScatterSample next = sample(*point.scatter, point.view, u, lobe);
    const bool last = bounce == bounces_;
    const Vec3f direction = next.pdf > 0 ? point.frame.to_world(next.light) : point.frame.normal;
    if (product_ != nullptr) sample_product(path, point, direction);
    // The ray after the last reflection looks for lights that light samples do not count.
    if (last && options_.sampling == LightSampling::light && !next.is_delta()) return false;
    if (is_black(next.weight) || !(next.pdf > 0)) return false;
    if (!may_go(point, direction)) return false;
    path.throughput *= next.weight;
    if (!last && bounce + 1 >= options_.roulette_bounce && !survives(path, stream.next_1d())) return false;
    path.pdf = next.pdf;
    path.from = point.surface.position;
    ray = {leave_surface(point.surface, direction), 0, direction, 1e30f};
    return true;
  }

  /// A direction by BRDF times environment, beside `along`, that of the BRDF's own sample.
  void sample_product(Path& path, const ShadingPoint& point, Vec3f along) {
    SampleStream& stream = path.sample->stream;
    const Vec2f u = stream.next_2d();
    const float keep = stream.next_1d();
    const ProductSample found = product_->environment.sample(*point.scatter, point.frame, point.view, u, keep,
                                                             along, path.product_density);
    if (is_black(found.light) || !may_go(point, found.direction)) return;
    space_.shadow_rays[shadows_] = {leave_surface(point.surface, found.direction), 0, found.direction, 1e30f};
    space_.candidates[shadows_++] = {path.throughput * found.light, &path};
  }

  /// Russian roulette: the path lives with probability q and then counts 1 / q times, so its mean stays. q is what it still
  /// carries; at most 0.95, so that no path lives for ever.
  static bool survives(Path& path, float chance) {
    const float q = std::clamp(max_channel(path.throughput), 0.05f, 0.95f);
    if (chance >= q) return false;
    path.throughput = (1 / q) * path.throughput;
    return true;
  }

  const RenderScene::Tables& tables_;
  const IntegratorOptions& options_;
  Rays& rays_;
  Workspace& space_ = workspace();
  const LightTable* lights_ = &tables_.lights;             ///< those that pick_light picks among
  const RenderScene::Tables::Product* product_ = nullptr;  ///< samples the environment where not null
  int bounces_ = 0;
  std::size_t count_ = 0;  ///< paths on their way
  std::size_t shadows_ = 0;
};

}  // namespace welkin
