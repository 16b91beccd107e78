#include "render_files.h"

#include <unistd.h>

#include <charconv>
#include <cmath>
#include <filesystem>

#include <welkin/error.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/codecs/ldr.h>

#include "flat_file.h"

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
  ToneMapOptions options;
  options.curve = command.curve == "filmic"     ? ToneCurve::filmic
                  : command.curve == "reinhard" ? ToneCurve::reinhard
                                                : ToneCurve::clamp;
  if (command.exposure == "auto") return options;
  double stops = 0;
  const char *begin = command.exposure.data(), *end = begin + command.exposure.size();
  const auto [rest, error] = std::from_chars(begin, end, stops);
  if (error != std::errc() || rest != end || !(std::abs(stops) <= 100))
    throw CLI::ValidationError(
        "--exposure", "is auto or a number of stops from -100 to 100, not '" + command.exposure + "'");
  options.exposure_ev = stops;
  return options;
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
