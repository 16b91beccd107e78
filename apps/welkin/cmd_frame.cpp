#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>

#include <welkin/error.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>

#include "commands.h"
#include "flat_file.h"
#include "frame_list.h"
#include "frame_picture.h"
#include "frame_reference.h"
#include "output_folder.h"
#include "shader_files.h"
#include "tone_input.h"

// welkin frame: one picture by the real-time renderer, without a display.

namespace welkin {
namespace {

Image first_three_channels(const Image& image) {
  Image rgb(image.width, image.height, 3);
  for (std::size_t i = 0; i < rgb.pixels.size() / 3; ++i)
    std::copy_n(&image.pixels[4 * i], 3, &rgb.pixels[3 * i]);
  return rgb;
}

void check_frame_output(const FrameCommand& command) {
  if (command.output.empty()) throw CLI::ValidationError("--output", "is required");
  check_flat_name(command.output);
  std::vector<std::string> outputs{command.output};
  if (command.reference_given) {
    outputs.push_back(beside_name(command.output, "-truth" + extension_of(command.output)));
    outputs.push_back(beside_name(command.output, "-difference.png"));
  }
  for (const std::string& output : outputs)
    for (const std::string& input : {command.file, command.environment, command.reference})
      check_output(output, input);
}

std::vector<std::uint8_t> encode_picture(const FrameCommand& command, const std::string& name,
                                         const Image& picture) {
  const std::string extension = extension_of(name);
  if (extension == ".exr") return encode_exr(picture, {ExrPixelType::single_float, 1});
  const Image rgb = picture.channels == 4 ? first_three_channels(picture) : picture;
  if (extension == ".png") return encode_png(tone_map(rgb, parse_tone(command.exposure, command.curve)));
  return encode_flat(name, rgb);
}

// The picture with the truth's exposure, so that both look alike where they are.
FrameCommand exposed_as(const FrameCommand& command, const Image& truth) {
  FrameCommand exposed = command;
  if (command.exposure == "auto") exposed.exposure = fmt::format("{}", automatic_exposure_ev(truth));
  return exposed;
}

void add_comparison(const FrameCommand& command, const FrameJob& job, const Image& picture,
                    FrameReport& report, std::vector<OutputFile>& files) {
  const TruthPicture truth = make_truth(command, job);
  const PictureErrors errors = compare_with_truth(picture, truth);
  report.errors = errors;
  const FrameCommand exposed = exposed_as(command, truth.radiance);
  files[0].bytes = encode_picture(exposed, command.output, picture);
  const std::string truth_file = beside_name(command.output, "-truth" + extension_of(command.output));
  files.push_back({truth_file, encode_picture(exposed, truth_file, truth.radiance)});
  files.push_back(
      {beside_name(command.output, "-difference.png"), encode_png(draw_difference(picture, truth, errors))});
  if (command.sheet.empty()) return;
  const ByteImage sheet = draw_sheet(report, picture, truth, parse_tone(command.exposure, command.curve));
  const bool png = extension_of(command.sheet) == ".png";
  files.push_back({command.sheet, png ? encode_png(sheet) : encode_jpeg(sheet)});
}

void run(const FrameCommand& command) {
  if (command.list) return list_techniques(command.json);
  check_frame_output(command);
  check_reference(command);
  parse_tone(command.exposure, command.curve);
  std::optional<NewFolder> folder;
  if (!command.shaders.empty()) folder.emplace(command.shaders);
  const ShaderFiles shaders;
  const auto job = make_frame_job(command);
  for (const std::string& warning : job->warnings) fmt::print(stderr, "welkin: warning: {}\n", warning);
  const Image picture = draw_picture(*job, command.supersample);
  FrameReport report;
  report.output = command.output;
  report.technique = job->choice.technique->name;
  report.truth = truth_name(truth_of(*job->choice.technique, job->choice.values));
  report.scene = job->renderer->scene().source;
  report.size = job->size;
  std::vector<OutputFile> files{{command.output, encode_picture(command, command.output, picture)}};
  if (command.reference_given) add_comparison(command, *job, picture, report, files);
  if (command.timed_frames > 0) report.times = time_passes(*job, command.timed_frames);
  if (folder)
    for (OutputFile& shader : shaders.files(command.shaders)) files.push_back(std::move(shader));
  write_files(files);
  if (folder) folder->keep();
  if (command.json) {
    fmt::print("{}\n", report_json(report));
  } else {
    print_report(report);
  }
}

}  // namespace

void add_frame_command(CLI::App& app) {
  auto command = std::make_shared<FrameCommand>();
  CLI::App* sub =
      app.add_subcommand("frame", "Draw one picture as the real-time renderer does, without a display");
  add_frame_options(*sub, *command);
  sub->footer(
      "Examples:\n  welkin frame --scene spheres --env park.hdr --technique prefiltered-ggx -o spheres.png\n"
      "  welkin frame --list");
  sub->callback([sub, command] {
    command->reference_given = sub->count("--reference") > 0;
    if (sub->count("--times") > 0 && command->timed_frames == 0) command->timed_frames = 9;
    run(*command);
  });
}

}  // namespace welkin
