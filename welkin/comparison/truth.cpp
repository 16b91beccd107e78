#include <welkin/comparison/truth.h>

#include <algorithm>
#include <optional>
#include <string>

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

Image captured_radiance(const Renderer& renderer) {
  const Cube captured = renderer.captured_environment();
  if (captured.empty())
    throw Error("technique " + std::string(renderer.technique().name) +
                ": has captured no environment that its truth could be lit by");
  return boxes_of_cube(captured);
}

std::optional<float> parameter_value(const TechniqueInfo& technique, const ParameterValues& values,
                                     std::string_view name) {
  for (std::size_t i = 0; i < std::min(values.size(), technique.parameters.size()); ++i)
    if (technique.parameters[i].name == name) return values[i];
  return std::nullopt;
}

std::string_view choice_name(const TechniqueInfo& technique, std::string_view parameter, float value) {
  for (const Parameter& known : technique.parameters)
    if (known.name == parameter && static_cast<std::size_t>(value) < known.choices.size())
      return known.choices[static_cast<std::size_t>(value)];
  return "";
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

Truth truth_of(const TechniqueInfo& technique, const ParameterValues& values) {
  const auto show = parameter_value(technique, values, "show");
  const bool shaded = show && technique.truth == Truth::ambient_occlusion &&
                      choice_name(technique, "show", *show) == "shaded";
  return shaded ? Truth::direct : technique.truth;
}

TruthPicture render_truth(const Renderer& renderer, const EnvironmentData& light, PictureSize size,
                          const TruthOptions& options) {
  const Truth truth = truth_of(renderer.technique(), renderer.values());
  TruthOptions own = options;
  if (truth == Truth::ambient_occlusion)
    own.occlusion_distance = parameter_value(renderer.technique(), renderer.values(), "radius")
                                 .value_or(options.occlusion_distance);
  Image radiance = truth == Truth::dynamic ? captured_radiance(renderer)
                                           : rotated(light.radiance, double{renderer.rotation_degrees()});
  return render_truth(renderer.prepared_scene(), std::move(radiance), renderer.camera(), size, truth, own);
}

}  // namespace welkin
