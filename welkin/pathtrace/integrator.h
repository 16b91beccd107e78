#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include <welkin/envmap/importance/environment_sampler.h>
#include <welkin/image/rgb.h>
#include <welkin/raytrace/ray_scene.h>
#include <welkin/scene/scene.h>

// One sample of one pixel: what every integrator computes. Independent of threads, tiles and of all other samples, so
// that pictures can be stopped, resumed and spread with the same bytes.

namespace welkin {

struct ImageBasedLight;  // image_based.h

enum class Integrator { direct, path, ambient_occlusion, image_based };

/// How light is looked for at a surface.
enum class LightSampling {
  bsdf,   ///< along the BRDF's samples only
  light,  ///< at the environment and the lights only; what mirrors show is still found by their one direction
  mis,    ///< both, weighted by multiple importance sampling (Veach & Guibas 1995)
  product,  ///< directions by BRDF times environment, with the other two by MIS
};

enum class MisHeuristic { balance, power };  // power: exponent 2

struct IntegratorOptions {
  Integrator integrator = Integrator::path;
  LightSampling sampling = LightSampling::mis;
  MisHeuristic heuristic = MisHeuristic::power;
  int max_bounces = 64;              ///< reflections after the first surface; path only; 0 is direct light
  int roulette_bounce = 4;           ///< from which on Russian roulette may end paths
  float occlusion_distance = 1e30f;  ///< ambient_occlusion: how far a ray looks, metres
  int occlusion_rays = 1;            ///< per sample, >= 1
  float clamp_indirect = 0;          ///< largest radiance of an indirect contribution; 0: no clamp, unbiased
  /// direct only. False: what precomputed maps approximate. The environment lights every surface as if nothing else were
  /// there, over the hemisphere of its shading normal; other lights do not, but surfaces that emit are seen.
  bool shadows = true;
  bool show_environment = true;      ///< behind the scene; else black, coverage says where
  std::uint32_t seed = 0;
  const ImageBasedLight* image_based =
      nullptr;  ///< what Integrator::image_based needs; kept alive by the caller
};

struct PixelSample {
  Rgb radiance;
  Rgb albedo;          ///< of the first surface; the environment and emitters give 0
  Vec3f normal;        ///< shading normal there, world; (0, 0, 0) for none
  float depth = 0;     ///< distance along the view axis, metres; 0 for none
  float coverage = 0;  ///< 1 where a surface was met
};

/// What sampling needs of a scene, made once: rays, tables of lights and materials. Immutable, thread-safe.
class RenderScene {
 public:
  /// environment: nothing for a black one. Both are kept alive by the caller. Throws Error naming the scene for one
  /// without anything that could be seen.
  RenderScene(const Scene& scene, const EnvironmentSampler* environment);
  ~RenderScene();
  RenderScene(RenderScene&&) noexcept;
  RenderScene& operator=(RenderScene&&) noexcept;

  struct Tables;
  const Tables& tables() const { return *tables_; }

 private:
  std::unique_ptr<Tables> tables_;
};

struct PictureSize {
  int width = 0, height = 0;
};

/// Sample `index` of pixel (x, y), (0, 0) at the top left, somewhere in the pixel (box filter).
PixelSample render_sample(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                          std::uint32_t index, const IntegratorOptions& options);

/// Which sample of a pixel: `seed` takes the place of IntegratorOptions::seed.
struct SampleNumber {
  std::uint32_t index = 0, seed = 0;
};

/// Samples of pixel (x, y) into out, one for each number: faster, since the rays of 16 are traced together. The same calls
/// give the same bytes; cut into other batches of 16, samples may differ by rounding (RayScene::closest of batches).
/// Threads that call often should hold a FlushDenormals.
void render_samples(const RenderScene& scene, const Camera& camera, PictureSize size, int x, int y,
                    std::span<const SampleNumber> numbers, const IntegratorOptions& options,
                    std::span<PixelSample> out);

}  // namespace welkin
