#include "frame_picture.h"

#include <welkin/error.h>

namespace welkin {
namespace {

TechniqueChoice choose_technique(const std::string& text) {
  try {
    return parse_technique(text);
  } catch (const Error& error) {
    throw CLI::ValidationError("--technique", error.what());
  }
}

std::shared_ptr<const EnvironmentData> load_light(const FrameCommand& command,
                                                  std::vector<std::string>& warnings) {
  if (command.environment == "none")
    throw CLI::ValidationError("--env", "is what lights the scene in real time; none leaves it black");
  const std::string name = command.environment.empty() ? "sky:" : command.environment;
  Environment environment = load_surroundings(command, name);
  for (const std::string& warning : environment.warnings) warnings.push_back(name + ": " + warning);
  IblOptions options;
  options.size = command.map_size;
  return make_environment_data(std::move(environment.radiance), options);
}

}  // namespace

std::unique_ptr<FrameJob> make_frame_job(const FrameCommand& command) {
  const TechniqueChoice choice = choose_technique(command.technique);
  Scene scene = load_scene(command);
  const Camera camera = aimed_camera(command, scene);
  const PictureSize size = picture_size(command, camera);
  auto job = std::make_unique<FrameJob>();
  for (const std::string& warning : scene.warnings) job->warnings.push_back(scene.source + ": " + warning);
  job->choice = choice;
  job->size = size;
  job->light = load_light(command, job->warnings);
  const TexelFormat maps = command.maps == "single" ? TexelFormat::rgba32f : TexelFormat::rgba16f;
  Renderer& renderer = job->renderer.emplace(RendererOptions{TexelFormat::rgba32f, maps});
  renderer.set_technique(*choice.technique, choice.values);
  renderer.set_scene(std::move(scene));
  renderer.set_environment(job->light);
  renderer.set_rotation(static_cast<float>(command.rotate_degrees));
  renderer.set_camera(camera);
  renderer.set_time(command.time_seconds);
  renderer.resize(command.supersample * size.width, command.supersample * size.height);
  renderer.show_background = !command.hide_environment;
  const bool progressive = renderer.progressive();
  job->frames = command.frames > 0 ? command.frames : progressive ? default_progressive_frames : 1;
  return job;
}

Image draw_picture(FrameJob& job, int supersample) {
  for (int frame = 0; frame < job.frames; ++frame) job.renderer->draw();
  return average_blocks(job.renderer->read_picture(), supersample);
}

Image average_blocks(const Image& image, int factor) {
  Image mean(image.width / factor, image.height / factor, image.channels);
  const float share = 1 / static_cast<float>(factor * factor);
  for (int y = 0; y < mean.height * factor; ++y)
    for (int x = 0; x < mean.width * factor; ++x)
      for (int c = 0; c < image.channels; ++c)
        mean.at(x / factor, y / factor)[c] += share * image.at(x, y)[c];
  return mean;
}

}  // namespace welkin
