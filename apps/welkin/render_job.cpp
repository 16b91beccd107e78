#include "render_job.h"

#include <algorithm>

#include <welkin/error.h>
#include <welkin/pathtrace/fingerprint.h>

namespace welkin {
namespace {

bool has_light(const Scene& scene) {
  return !scene.lights.empty() || std::any_of(scene.materials.begin(), scene.materials.end(),
                                              [](const Material& m) { return !is_black(m.emission); });
}

LightSampling sampling_of(const std::string& name) {
  if (name == "bsdf") return LightSampling::bsdf;
  if (name == "light") return LightSampling::light;
  return name == "product" ? LightSampling::product : LightSampling::mis;
}

Integrator integrator_of(const std::string& name) {
  if (name == "direct") return Integrator::direct;
  if (name == "ao") return Integrator::ambient_occlusion;
  return name == "ibl" ? Integrator::image_based : Integrator::path;
}

PictureOptions picture_options(const RenderCommand& command, const Camera& camera) {
  PictureOptions options;
  options.size = picture_size(command, camera);
  options.target_error = command.error;
  options.samples = command.error > 0 ? command.most_samples : command.samples;
  options.least_samples = std::min(command.least_samples, options.samples);
  IntegratorOptions& integrator = options.integrator;
  integrator.integrator = integrator_of(command.integrator);
  integrator.sampling = sampling_of(command.sampling);
  integrator.heuristic = command.heuristic == "balance" ? MisHeuristic::balance : MisHeuristic::power;
  integrator.max_bounces = command.bounces;
  if (command.occlusion_distance > 0)
    integrator.occlusion_distance = static_cast<float>(command.occlusion_distance);
  integrator.clamp_indirect = static_cast<float>(command.clamp);
  integrator.shadows = !command.no_shadows;
  integrator.show_environment = !command.hide_environment;
  integrator.seed = command.seed;
  return options;
}

}  // namespace

RenderJob make_render_job(const RenderCommand& command) {
  RenderJob job;
  job.scene = load_scene(command);
  for (const std::string& warning : job.scene.warnings)
    job.warnings.push_back(job.scene.source + ": " + warning);
  job.camera = aimed_camera(command, job.scene);
  job.options = picture_options(command, job.camera);
  const std::string name = !command.environment.empty() ? command.environment
                           : has_light(job.scene)       ? "none"
                                                        : "sky:";
  if (name == "none") {
    if (job.options.integrator.integrator == Integrator::image_based)
      throw Error("--integrator ibl shades by an environment: give one with --env");
    if (!has_light(job.scene) && job.options.integrator.integrator != Integrator::ambient_occlusion)
      job.warnings.push_back(job.scene.source +
                             ": has no light, and neither has --env none: the picture is black");
    job.fingerprint = picture_fingerprint(job.scene, job.camera, nullptr, job.options);
    return job;
  }
  Environment environment = load_surroundings(command, name);
  for (const std::string& warning : environment.warnings) job.warnings.push_back(name + ": " + warning);
  job.fingerprint = picture_fingerprint(job.scene, job.camera, &environment.radiance, job.options);
  if (job.options.integrator.integrator == Integrator::image_based) {
    const IblOptions ibl;
    job.image_based =
        std::make_unique<ImageBasedLight>(make_image_based_light(make_ibl(environment.radiance, ibl), ibl));
    job.options.integrator.image_based = job.image_based.get();
  }
  job.environment.emplace(std::move(environment.radiance));
  return job;
}

}  // namespace welkin
