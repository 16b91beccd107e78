#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/pathtrace/checkpoint.h>

#include "commands.h"
#include "progress.h"
#include "render_files.h"
#include "render_job.h"
#include "render_options.h"
#include "render_strategies.h"
#include "stop_signal.h"

// welkin render: a picture of a scene with its standard error.

namespace welkin {
namespace {

using std::chrono::steady_clock;

double seconds_since(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

// Looks after a picture while it is made: progress, files to watch, states to go on with, Ctrl-C.
class Attendant {
 public:
  Attendant(const RenderCommand& command, const RenderJob& job, const PictureState& state)
      : command_(command), job_(job), state_(state), progress_("rendering") {}

  bool operator()(const PictureProgress& progress) {
    progress_.show(progress.share);
    if (is_due(command_.watch_seconds, last_watch_)) write_files(render_files(command_, state_));
    if (is_due(command_.state_seconds, last_state_)) write_state();
    return stop_.signal_number() == 0;
  }
  void write_state() const {
    write_file(state_name(command_.output), encode_checkpoint(state_, job_.fingerprint));
  }
  int signal_number() const { return stop_.signal_number(); }

 private:
  static bool is_due(double period, steady_clock::time_point& last) {
    if (period <= 0 || seconds_since(last) < period) return false;
    last = steady_clock::now();
    return true;
  }
  const RenderCommand& command_;
  const RenderJob& job_;
  const PictureState& state_;
  StopLater stop_;
  ProgressLine progress_;
  steady_clock::time_point last_watch_ = steady_clock::now(), last_state_ = last_watch_;
};

std::uint64_t sample_count(const PictureState& state) {
  std::uint64_t samples = 0;
  for (const std::uint32_t count : state.count) samples += count;
  return samples;
}

PictureState first_state(const RenderCommand& command, const RenderJob& job) {
  const std::string name = state_name(command.output);
  if (!std::filesystem::exists(name)) {
    if (command.resume) fmt::print(stderr, "welkin: {} is not there; the picture is started anew\n", name);
    return make_picture_state(job.options.size);
  }
  if (!command.resume) {
    fmt::print(stderr, "welkin: warning: {} is replaced; --resume would go on with it\n", name);
    return make_picture_state(job.options.size);
  }
  return decode_checkpoint(read_file(name), name, job.options.size, job.fingerprint);
}

void report(const RenderCommand& command, const PictureState& state, std::uint64_t new_samples,
            double seconds) {
  const PictureError error = picture_error(state, command.error);
  fmt::print("{}: {} x {}, {:.4g} samples a pixel, {:.2f} s, {:.3g} million samples a second\n",
             command.output, state.size.width, state.size.height, error.mean_samples, seconds,
             static_cast<double>(new_samples) / std::max(seconds, 1e-9) / 1e6);
  fmt::print("standard error of luminance, root mean square: {:.3g}, relative {:.3g}\n",
             error.mean_standard_error, error.mean_relative_error);
  if (command.error > 0)
    fmt::print("{:.2f} % of the pixels have a relative error of {:g} or less, the worst {:.3g}\n",
               100 * error.share_reached, command.error, error.worst_relative_error);
  if (state.faults > 0)
    fmt::print(stderr, "welkin: warning: {} samples were not finite and count as black\n", state.faults);
}

// Both files, then the state goes, or stays where it is asked for.
void finish(const RenderCommand& command, const PictureState& state, const Attendant& attendant) {
  write_files(render_files(command, state));
  if (command.keep_state) return attendant.write_state();
  std::error_code none;
  std::filesystem::remove(state_name(command.output), none);
}

// --sampling compare: the converged picture as .exr, all pictures as a sheet .png, the figures as .json.
void run_comparison(const RenderCommand& command, const RenderJob& job) {
  std::optional<StrategyComparison> comparison;
  const StopLater stop;
  {
    std::string shown;
    std::unique_ptr<ProgressLine> line;
    comparison = compare_strategies(job, [&](const std::string& what, double share) {
      if (what != shown) line.reset(), line = std::make_unique<ProgressLine>(what);
      shown = what;
      line->show(share);
      return stop.signal_number() == 0;
    });
  }
  if (!comparison) throw Stopped(stop.signal_number(), "stopped; nothing was written");
  const std::string json = strategy_json(*comparison);
  const std::vector<OutputFile> files{
      {command.output, encode_exr(comparison->converged.radiance, {ExrPixelType::single_float, 1})},
      {picture_name(command.output), encode_png(strategy_sheet(*comparison, tone_options(command)))},
      {std::filesystem::path(command.output).replace_extension(".json"), {json.begin(), json.end()}}};
  write_files(files);
  print_strategies(*comparison);
}

void run(const RenderCommand& command) {
  check_render_output(command);
  const RenderJob job = make_render_job(command);
  for (const std::string& warning : job.warnings) fmt::print(stderr, "welkin: warning: {}\n", warning);
  if (command.sampling == "compare") return run_comparison(command, job);
  PictureState state = first_state(command, job);
  const RenderScene scene(job.scene, job.environment ? &*job.environment : nullptr);
  const auto start = steady_clock::now();
  const std::uint64_t before = sample_count(state);
  Attendant attendant(command, job, state);
  const bool done = render_picture(state, scene, job.camera, job.options, std::ref(attendant));
  const double seconds = seconds_since(start);
  if (done) {
    finish(command, state, attendant);
    return report(command, state, sample_count(state) - before, seconds);
  }
  attendant.write_state();
  write_files(render_files(command, state));
  throw Stopped(attendant.signal_number(),
                fmt::format("stopped after {:.4g} samples a pixel; the same command with --resume goes on",
                            picture_error(state).mean_samples));
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App* sub = app.add_subcommand("render", "Render a scene in an environment, with its standard error");
  add_render_options(*sub, *command);
  sub->footer(
      "Examples:\n  welkin render --scene spheres --env park.hdr --spp 256 -o spheres.exr\n"
      "  welkin render room.glb --env none --error 0.02 --watch 5 -o room.exr\n"
      "  welkin render --scene spheres --env park.hdr --sampling compare -o strategies.exr");
  sub->callback([sub, command] {
    check_contradictions(*sub, *command);
    run(*command);
  });
}

}  // namespace welkin
