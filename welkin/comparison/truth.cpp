#include <welkin/comparison/truth.h>

#include <welkin/error.h>
#include <welkin/sphere/orientation.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

IntegratorOptions integrator_for(Truth truth, const TruthOptions& options) {
  IntegratorOptions integrator;
  integrator.seed = options.seed;
  integrator.sampling = options.sampling;
  integrator.occlusion_distance = options.occlusion_distance;
  integrator.integrator = Integrator::direct;
  switch (truth) {
    case Truth::unshadowed:
    case Truth::dynamic: integrator.shadows = false; break;
    case Truth::direct: break;
    case Truth::path: integrator.integrator = Integrator::path; break;
    case Truth::ambient_occlusion: integrator.integrator = Integrator::ambient_occlusion; break;
  }
  return integrator;
}

Image rotated(const Image& radiance, double degrees) {
  SphereMap map = make_sphere_map({Mapping::equirectangular, radiance.width, radiance.height});
  map.image = radiance;
  return rotated_about_y(map, degrees).image;
}

// The truth's environments are boxes of constant radiance on an equirectangular grid; four texels for one of the cube's
// keep the cube's own boxes to the grid's width, with nothing invented in between.
Image boxes_of_cube(const Cube& cube) {
  ResampleOptions options;
  options.interpolate = false;
  return cube_to_equirect(cube, 8 * cube.size, 4 * cube.size, options);
}

}  // namespace

TruthPicture render_truth(const Scene& scene, Image radiance, const Camera& camera, PictureSize size,
                          Truth truth, const TruthOptions& options) {
  const EnvironmentSampler environment(std::move(radiance));
  const RenderScene render_scene(scene, &environment);
  PictureOptions picture;
  picture.size = size;
  picture.samples = options.samples;
  picture.integrator = integrator_for(truth, options);
  PictureState state = make_picture_state(size);
  render_picture(state, render_scene, camera, picture, options.observer);
  PictureLayers layers = make_picture_layers(state);
  return {std::move(layers.radiance), std::move(layers.standard_error), std::move(layers.coverage)};
}

TruthPicture render_truth(const Renderer& renderer, const EnvironmentData& light, PictureSize size,
                          const TruthOptions& options) {
  const Truth truth = renderer.technique().truth;
  Image radiance;
  if (truth == Truth::dynamic) {
    const Cube captured = renderer.captured_environment();
    if (captured.empty())
      throw Error("technique " + std::string(renderer.technique().name) +
                  ": has captured no environment that its truth could be lit by");
    radiance = boxes_of_cube(captured);
  } else {
    radiance = rotated(light.radiance, renderer.rotation_degrees());
  }
  return render_truth(renderer.prepared_scene(), std::move(radiance), renderer.camera(), size, truth,
                      options);
}

}  // namespace welkin
