#include "render_files.h"

#include <unistd.h>

#include <filesystem>

#include <welkin/error.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/codecs/ldr.h>

#include "flat_file.h"
#include "tone_input.h"

namespace welkin {

std::string picture_name(const std::string& exr) {
  return std::filesystem::path(exr).replace_extension(".png").string();
}

std::string state_name(const std::string& exr) { return exr + ".state"; }

void check_render_output(const RenderCommand& command) {
  if (extension_of(command.output) != ".exr")
    throw CLI::ValidationError("--output", "is an OpenEXR file; give it a name that ends in .exr");
  for (const std::string& input : {command.file, command.environment})
    for (const std::string& output :
         {command.output, picture_name(command.output), state_name(command.output)})
      check_output(output, input);
  const std::filesystem::path folder = std::filesystem::absolute(command.output).parent_path();
  for (const std::string& output : {command.output, picture_name(command.output), state_name(command.output)})
    if (std::filesystem::is_directory(output)) throw Error(output, "cannot write: Is a directory");
  if (::access(folder.c_str(), W_OK) != 0)
    throw Error(command.output, "cannot be written: the folder " + folder.string() + " is read-only");
  tone_options(command);
}

ToneMapOptions tone_options(const RenderCommand& command) {
  return parse_tone(command.exposure, command.curve);
}

std::vector<OutputFile> render_files(const RenderCommand& command, const PictureState& state) {
  PictureLayers layers = make_picture_layers(state);
  std::vector<OutputFile> files;
  files.push_back(
      {picture_name(command.output), encode_png(tone_map(layers.radiance, tone_options(command)))});
  const std::vector<std::string> rgb{"R", "G", "B"};
  const ExrLayers exr{{{"", rgb, std::move(layers.radiance)},
                       {"stderr", rgb, std::move(layers.standard_error)},
                       {"albedo", rgb, std::move(layers.albedo)},
                       {"normal", {"X", "Y", "Z"}, std::move(layers.normal)},
                       {"depth", {"Z"}, std::move(layers.depth)},
                       {"coverage", {"Y"}, std::move(layers.coverage)},
                       {"samples", {"Y"}, std::move(layers.samples)}},
                      picture_replicates - 1};
  files.push_back({command.output, encode_exr_layers(exr)});
  return files;
}

}  // namespace welkin
