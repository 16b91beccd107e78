#pragma once
#include <cstdint>

#include <welkin/image/image.h>
#include <welkin/pathtrace/picture.h>
#include <welkin/realtime/renderer.h>

// The path tracer's picture of what a real-time technique shows: the truth that its error is measured against.

namespace welkin {

struct TruthOptions {
  std::uint32_t samples = 64;  ///< a pixel
  std::uint32_t seed = 0;
  LightSampling sampling = LightSampling::mis;
  float occlusion_distance = 1e30f;  ///< ambient_occlusion: how far a ray looks, metres
  PictureObserver observer;          ///< false stops, and the picture has what it has
};

struct TruthPicture {
  Image radiance;        ///< 3 channels; for Truth::ambient_occlusion the open share
  Image standard_error;  ///< 3 channels: of the mean in `radiance`
  Image coverage;        ///< 1 channel: share of the pixel's samples that met a surface
};

/// `scene` is what the technique shows (Renderer::prepared_scene), `radiance` the environment in the world, equirectangular.
/// unshadowed and dynamic: IntegratorOptions::shadows = false. Pixels are means over their square (box filter). The
/// environment is seen behind the scene.
TruthPicture render_truth(const Scene& scene, Image radiance, const Camera& camera, PictureSize size,
                          Truth truth, const TruthOptions& options = {});

/// What this technique stands for with these values: its own truth, but Truth::direct for a technique of occlusion whose
/// parameter "show" is at its choice "shaded".
Truth truth_of(const TechniqueInfo& technique, const ParameterValues& values);

/// All that the truth of a renderer's picture needs of it, for a thread that has no OpenGL.
struct TruthView {
  Scene scene;  ///< as the technique shows it
  Camera camera;
  Truth truth = Truth::unshadowed;  ///< truth_of() its technique and values
  float rotation_degrees = 0;
  float occlusion_distance = 1e30f;
  Cube captured;  ///< Truth::dynamic: what lights the scene
  bool show_environment = true;
};

/// Of what the renderer last drew. A parameter "radius" of a technique of occlusion takes the place of occlusion_distance.
TruthView truth_view(const Renderer& renderer, float occlusion_distance = 1e30f);

/// What lights it: `light` is what the renderer's set_environment was given. Throws Error where a dynamic technique has
/// captured nothing yet.
Image truth_radiance(const TruthView& view, const EnvironmentData& light);

/// How the path tracer is set for it; the view's occlusion_distance counts, not that of the options.
IntegratorOptions truth_integrator(const TruthView& view, const TruthOptions& options = {});

/// Of what the renderer last drew, by its own technique, camera and rotation; for Truth::dynamic by the environment that
/// the technique captured. `light` is what set_environment was given; size: the truth's own, which the renderer's
/// picture may have a multiple of. A parameter "radius" of a technique of occlusion takes the place of
/// options.occlusion_distance. Throws Error where a dynamic technique has captured nothing yet.
TruthPicture render_truth(const Renderer& renderer, const EnvironmentData& light, PictureSize size,
                          const TruthOptions& options = {});

}  // namespace welkin
