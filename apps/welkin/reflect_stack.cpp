#include "reflect_stack.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>

#include "json_text.h"
#include "output_folder.h"

namespace welkin {
namespace {

constexpr const char* units =
    "angles and axes in radians; energy has no unit and a value a channel; stored value * stored_scale is "
    "radiance in the unit of the input";

nlohmann::ordered_json describe(const NamedCube& named, const std::string& file,
                                const EncodedTexture& texture) {
  return {{"file", file},
          {"size", named.cube.size()},
          {"levels", named.cube.levels.size()},
          {"format", pixel_format_name(PixelFormat::rgba16f)},
          {"stored_scale", texture.stored_scale}};
}

}  // namespace

void write_stack(const std::string& folder, const StackFiles& stack, const std::string& input) {
  const std::filesystem::path directory = folder;
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(stack.json), cubes;
  std::vector<OutputFile> files;
  for (const NamedCube& named : stack.cubes) {
    const std::string file = named.name + ".ktx2";
    EncodedTexture texture = encode_ktx2(named.cube);
    cubes.push_back(describe(named, file, texture));
    files.push_back({directory / file, std::move(texture.bytes)});
  }
  json["units"] = units;
  json["cubes"] = cubes;
  const std::string text = json_text(json) + "\n";
  files.push_back({directory / "stack.json", {text.begin(), text.end()}});
  std::error_code none;
  for (const OutputFile& file : files)
    if (std::filesystem::equivalent(file.path, input, none))
      throw Error(input, "is the input and would be overwritten; choose another folder with --stack");
  NewFolder made(directory);
  write_files(files);
  made.keep();
}

}  // namespace welkin
