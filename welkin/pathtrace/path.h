#pragma once
#include <algorithm>
#include <limits>

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

/// Needs `std::optional<Hit> closest(const Ray&)` and `bool occluded(const Ray&)` of Rays.
template <class Rays>
class PathTracer {
 public:
  PathTracer(const RenderScene::Tables& tables, const IntegratorOptions& options, Rays& rays)
      : tables_(tables), options_(options), rays_(rays) {
    bounces_ = options.integrator == Integrator::direct ? 0 : std::max(options.max_bounces, 0);
  }

  /// Fills radiance, albedo, normal and coverage of `sample`; position of the first surface, if any, in `first`.
  void trace(Ray ray, SampleStream& stream, PixelSample& sample, Vec3f& first) {
    Path path(ray);
    for (int bounce = 0;; ++bounce) {
      const std::optional<Hit> hit = rays_.closest(path.ray);
      if (!hit) {
        add_environment(path, bounce, sample.radiance);
        return;
      }
      ShadingPoint point;
      point.surface = surface_at(tables_.rays, *hit, path.ray);
      if (tables_.materials[point.surface.material].emits) add_emission(path, bounce, *hit, point, sample);
      if (bounce > bounces_) return;  // this ray only looked for light
      prepare_shading(tables_.scene, tables_.materials, path.ray.direction, point);
      if (bounce == 0) {
        first = point.surface.position;
        sample.coverage = 1;
        sample.normal = point.frame.normal;
        sample.albedo = approximate_albedo(*point.scatter, point.view);
      }
      const Vec2f choice = stream.next_2d(), on_light = stream.next_2d();
      add(path.throughput * direct_light(point, choice.x, on_light), bounce, sample.radiance);
      if (!go_on(path, point, bounce, choice.y, stream)) return;
    }
  }

 private:
  struct Path {
    explicit Path(const Ray& first) : ray(first) {}
    Ray ray;
    Rgb throughput{1, 1, 1};
    float pdf =
        std::numeric_limits<float>::infinity();  ///< of ray's direction; infinite for camera and mirrors
    Vec3f from;                                  ///< the surface that the ray left
  };
  static constexpr float delta_pdf = 3e38f;

  /// An indirect contribution (light that was reflected twice at least) is clamped where asked for.
  void add(Rgb light, int reflections_before, Rgb& sum) const {
    if (options_.clamp_indirect > 0 && reflections_before > 0) {
      const float most = max_channel(light);
      if (most > options_.clamp_indirect) light = (options_.clamp_indirect / most) * light;
    }
    sum += light;
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

  void add_environment(const Path& path, int bounce, Rgb& radiance) const {
    if (tables_.environment == nullptr || (bounce == 0 && !options_.show_environment)) return;
    const EnvironmentSample sky = tables_.environment->at(path.ray.direction);
    const float weight = weight_of_path(path, tables_.lights.pdf_of_environment(sky.pdf));
    add(weight * path.throughput * sky.radiance, bounce - 1, radiance);
  }

  void add_emission(const Path& path, int bounce, const Hit& hit, const ShadingPoint& point,
                    PixelSample& sample) const {
    const Surface& s = point.surface;
    const Rgb emission = tables_.lights.emission(s.material, s.front, s.texcoords);
    if (is_black(emission)) return;
    const float light_pdf = path.pdf < delta_pdf ? tables_.lights.pdf_of_surface(path.from, hit, s) : 0.0f;
    add(weight_of_path(path, light_pdf) * path.throughput * emission, bounce - 1, sample.radiance);
  }

  bool visible(const Surface& surface, const LightSample& light) const {
    Ray ray;
    ray.origin = leave_surface(surface, light.direction);
    ray.direction = light.direction;
    if (light.distance < 1e30f) {  // between two points that are both off their surfaces
      const Vec3f way = light.target - ray.origin;
      const float squared = dot(way, way);
      if (!(squared > 0)) return true;
      const float distance = std::sqrt(squared);
      ray.direction = (1 / distance) * way;
      ray.far = distance * (1 - 0x1p-20f);
    }
    return !rays_.occluded(ray);
  }

  /// What the surface reflects of light straight from one light that was picked.
  Rgb direct_light(const ShadingPoint& point, float select, Vec2f u) const {
    const LightTable& lights = tables_.lights;
    const bool punctual_only = options_.sampling == LightSampling::bsdf;
    if (lights.empty() || (punctual_only && !lights.has_punctual_lights()) || is_delta(*point.scatter)) {
      return {};
    }
    const Vec3f from = point.surface.position;
    const LightSample light =
        punctual_only ? lights.sample_punctual(from, select) : lights.sample(from, select, u);
    if (is_black(light.radiance) || !(light.pdf > 0) || !point.faces(light.direction)) return {};
    const Vec3f local = point.frame.to_local(light.direction);
    if (!(local.z > 0)) return {};
    const ScatterValue scattered = evaluate_with_pdf(*point.scatter, local, point.view);
    const Rgb reflected = scattered.value * light.radiance;
    if (is_black(reflected) || !visible(point.surface, light)) return {};
    const bool shared = options_.sampling == LightSampling::mis && !light.is_delta;
    const float weight = shared ? mis_weight(options_.heuristic, light.pdf, scattered.pdf) : 1.0f;
    return (weight / light.pdf) * reflected;
  }

  /// Takes the path's next direction. False where it ends here.
  bool go_on(Path& path, const ShadingPoint& point, int bounce, float lobe, SampleStream& stream) const {
    const ScatterSample next = sample(*point.scatter, point.view, stream.next_2d(), lobe);
    const bool last = bounce == bounces_;
    // The ray after the last reflection looks for lights that light samples do not count.
    if (last && options_.sampling == LightSampling::light && !next.is_delta()) return false;
    if (is_black(next.weight) || !(next.pdf > 0)) return false;
    const Vec3f direction = point.frame.to_world(next.light);
    if (!point.faces(direction)) return false;
    path.throughput *= next.weight;
    if (!last && bounce + 1 >= options_.roulette_bounce && !survives(path, stream.next_1d())) return false;
    path.pdf = next.pdf;
    path.from = point.surface.position;
    path.ray = {leave_surface(point.surface, direction), 0, direction, 1e30f};
    return true;
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
  int bounces_ = 0;
};

}  // namespace welkin
