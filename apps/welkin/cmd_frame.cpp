#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include <welkin/error.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>

#include "commands.h"
#include "flat_file.h"
#include "frame_list.h"
#include "frame_picture.h"
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
  for (const std::string& input : {command.file, command.environment}) check_output(command.output, input);
}

std::vector<std::uint8_t> encode_picture(const FrameCommand& command, const Image& picture) {
  const std::string extension = extension_of(command.output);
  if (extension == ".exr") return encode_exr(picture, {ExrPixelType::single_float, 1});
  const Image rgb = first_three_channels(picture);
  if (extension == ".png") return encode_png(tone_map(rgb, parse_tone(command.exposure, command.curve)));
  return encode_flat(command.output, rgb);
}

void run(const FrameCommand& command) {
  if (command.list) return list_techniques(command.json);
  if (command.json) throw CLI::ValidationError("--json", "is for --list");
  check_frame_output(command);
  parse_tone(command.exposure, command.curve);
  const auto job = make_frame_job(command);
  for (const std::string& warning : job->warnings) fmt::print(stderr, "welkin: warning: {}\n", warning);
  const Image picture = draw_picture(*job, command.supersample);
  write_file(command.output, encode_picture(command, picture));
  fmt::print("{}: {} x {}, {}\n", command.output, picture.width, picture.height, job->choice.technique->name);
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
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
