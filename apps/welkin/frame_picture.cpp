#include "frame_picture.h"

#include <algorithm>
#include <chrono>

#include <welkin/comparison/picture_errors.h>
#include <welkin/error.h>
#include <welkin/realtime/ibl_folder.h>

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
  if (is_ibl_folder(name)) {
    IblFolder set = load_ibl_folder(name);
    for (std::string& warning : set.warnings) warnings.push_back(std::move(warning));
    return set.light;
  }
  Environment environment = load_surroundings(command, name);
  for (const std::string& warning : environment.warnings) warnings.push_back(name + ": " + warning);
  IblOptions options;
  options.size = command.map_size;
  return make_environment_data(std::move(environment.radiance), options);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

double draw_and_wait(Renderer& renderer) {
  const auto start = std::chrono::steady_clock::now();
  renderer.draw();
  wait_for_gl();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
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
  return mean_of_blocks(job.renderer->read_picture(), supersample);
}

std::vector<FrameTime> time_passes(FrameJob& job, int frames) {
  Renderer& renderer = *job.renderer;
  std::vector<FrameTime> rows;
  std::vector<std::vector<double>> times;  // of each pass
  std::vector<double> whole;
  for (int frame = 0; frame < frames; ++frame) {
    renderer.timer().enabled = false;
    whole.push_back(draw_and_wait(renderer));  // without the waits between the passes
    renderer.timer().enabled = true;
    renderer.draw();
    const std::vector<PassTime>& passes = renderer.timer().passes();
    if (frame == 0)
      for (const PassTime& pass : passes) rows.push_back({pass.name, pass.depth, 0});
    times.resize(rows.size());
    for (std::size_t i = 0; i < std::min(passes.size(), rows.size()); ++i)
      times[i].push_back(passes[i].milliseconds);
  }
  renderer.timer().enabled = false;
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].milliseconds = median(times[i]);
  rows.push_back({"frame", 0, median(whole)});
  return rows;
}

}  // namespace welkin
