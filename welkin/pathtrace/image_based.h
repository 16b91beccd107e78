#pragma once
#include <algorithm>
#include <span>

#include <welkin/envmap/ibl.h>
#include <welkin/pathtrace/camera_ray.h>
#include <welkin/pathtrace/render_scene.h>
#include <welkin/raytrace/ray_scene.h>
#include <welkin/sampling/sobol.h>

// What a real-time engine makes of the precomputed maps of an environment, by the path tracer's camera, so that the
// approximation and the truth can be compared pixel by pixel. As in engines nothing casts a shadow, surfaces do not light
// each other, and lights other than the environment are left out.

namespace welkin {

/// The part of an IblSet that shading reads.
struct ImageBasedLight {
  CubeMips specular;
  Cube irradiance;  ///< E
  DfgTable dfg;
  LevelLaw law = LevelLaw::linear;
  DfgForm form = DfgForm::scale_bias;
};

/// Takes the maps out of a set that was made with these options.
ImageBasedLight make_image_based_light(IblSet&& set, const IblOptions& options);

/// Radiance towards the unit vector `view` from a surface of unit `normal`, n.v > 0, both in the world:
///   (F0 scale + f90 bias) M specular(reflected view, level of the roughness)                 split sum (Karis 2013)
///   + diffuse (1 - C) irradiance(normal) / pi,   C = (f0 scale + f90 bias) M of the dielectric part
/// with scale, bias = dfg(n.v, perceptual roughness), and M = 1 + F0 (1 / (scale + bias) - 1) (Turquin 2019) for a
/// compensated material with DfgForm::scale_bias. Models are read as metallic-roughness: rough diffuse as Lambert, powers of
/// cosines as GGX of alpha^2 = 2 / (N + 2) with F0 = color, conductors by F0 at normal incidence, two widths by the root of
/// their product.
Rgb image_based_radiance(const ImageBasedLight& light, const Scatter& scatter, Vec3f normal, Vec3f view);

/// The integrator, as a template on what traces the rays (see path.h). Needs options.image_based.
template <class Rays>
class ImageBasedTracer {
 public:
  ImageBasedTracer(const RenderScene::Tables& tables, const IntegratorOptions& options, Rays& rays)
      : tables_(tables), options_(options), rays_(rays) {}

  struct Sample {
    PixelSample* pixel = nullptr;
    Vec3f first;

    void begin(SampleNumber, const SampleStream&) {}
  };

  void trace(std::span<const Ray> camera_rays, Sample* samples) {
    Hit hits[RayScene::batch_size];
    const std::uint32_t met = rays_.closest(camera_rays, hits, RayKind::side_by_side);
    prefetch_surfaces(tables_.rays, met, hits);
    for (std::size_t i = 0; i < camera_rays.size(); ++i) {
      if ((met >> i & 1) != 0) {
        shade(camera_rays[i], hits[i], samples[i]);
      } else if (options_.show_environment && tables_.environment != nullptr) {
        samples[i].pixel->radiance = tables_.environment->radiance(camera_rays[i].direction);
      }
    }
  }

 private:
  void shade(const Ray& ray, const Hit& hit, Sample& sample) {
    ShadingPoint point;
    point.surface = surface_at(tables_.rays, hit, ray);
    prepare_shading(tables_.scene, tables_.materials, ray.direction, point);
    const Surface& s = point.surface;
    sample.first = s.position;
    PixelSample& pixel = *sample.pixel;
    pixel.coverage = 1;
    pixel.normal = point.frame.normal;
    pixel.albedo = approximate_albedo(*point.scatter, point.view);
    pixel.radiance =
        image_based_radiance(*options_.image_based, *point.scatter, point.frame.normal, -ray.direction);
    if (tables_.materials[s.material].emits)
      pixel.radiance += tables_.lights.emission(s.material, s.front, s.texcoords);
  }

  const RenderScene::Tables& tables_;
  const IntegratorOptions& options_;
  Rays& rays_;
};

}  // namespace welkin
