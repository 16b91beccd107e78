#include <welkin/comparison/truth.h>

#include <algorithm>
#include <optional>
#include <string>

#include <welkin/error.h>
#include <welkin/sphere/orientation.h>
#include <welkin/sphere/resample.h>

namespace welkin {
namespace {

IntegratorOptions integrator_for(Truth truth, const TruthOptions& options, bool show_environment) {
  IntegratorOptions integrator;
  integrator.seed = options.seed;
  integrator.sampling = options.sampling;
  integrator.occlusion_distance = options.occlusion_distance;
  integrator.integrator = Integrator::direct;
  integrator.show_environment = show_environment;
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

TruthPicture render(const Scene& scene, Image radiance, const Camera& camera, PictureSize size,
                    const IntegratorOptions& integrator, const TruthOptions& options) {
  const EnvironmentSampler environment(std::move(radiance));
  const RenderScene render_scene(scene, &environment);
  PictureOptions picture;
  picture.size = size;
  picture.samples = options.samples;
  picture.integrator = integrator;
  PictureState state = make_picture_state(size);
  render_picture(state, render_scene, camera, picture, options.observer);
  PictureLayers layers = make_picture_layers(state);
  return {std::move(layers.radiance), std::move(layers.standard_error), std::move(layers.coverage)};
}

}  // namespace

TruthPicture render_truth(const Scene& scene, Image radiance, const Camera& camera, PictureSize size,
                          Truth truth, const TruthOptions& options) {
  return render(scene, std::move(radiance), camera, size, integrator_for(truth, options, true), options);
}

Truth truth_of(const TechniqueInfo& technique, const ParameterValues& values) {
  const auto show = parameter_value(technique, values, "show");
  const bool shaded = show && technique.truth == Truth::ambient_occlusion &&
                      choice_name(technique, "show", *show) == "shaded";
  return shaded ? Truth::direct : technique.truth;
}

TruthView truth_view(const Renderer& renderer, float occlusion_distance) {
  TruthView view;
  view.scene = renderer.prepared_scene();
  view.camera = renderer.camera();
  view.truth = truth_of(renderer.technique(), renderer.values());
  view.rotation_degrees = renderer.rotation_degrees();
  view.occlusion_distance = occlusion_distance;
  if (view.truth == Truth::ambient_occlusion)
    view.occlusion_distance =
        parameter_value(renderer.technique(), renderer.values(), "radius").value_or(occlusion_distance);
  if (view.truth == Truth::dynamic) view.captured = renderer.captured_environment();
  view.show_environment = renderer.show_background;
  return view;
}

Image truth_radiance(const TruthView& view, const EnvironmentData& light) {
  if (view.truth != Truth::dynamic) return rotated(light.radiance, double{view.rotation_degrees});
  if (view.captured.empty())
    throw Error("the technique has captured no environment that its truth could be lit by");
  return boxes_of_cube(view.captured);
}

IntegratorOptions truth_integrator(const TruthView& view, const TruthOptions& options) {
  TruthOptions own = options;
  own.occlusion_distance = view.occlusion_distance;
  return integrator_for(view.truth, own, view.show_environment);
}

TruthPicture render_truth(const Renderer& renderer, const EnvironmentData& light, PictureSize size,
                          const TruthOptions& options) {
  const TruthView view = truth_view(renderer, options.occlusion_distance);
  return render(view.scene, truth_radiance(view, light), view.camera, size, truth_integrator(view, options),
                options);
}

}  // namespace welkin
