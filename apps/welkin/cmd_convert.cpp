#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "environment_options.h"
#include "flat_file.h"
#include "texture_options.h"

#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/faults.h>
#include <welkin/image/output_file.h>
#include <welkin/sphere/cube_layout.h>
#include <welkin/sphere/cube_mips.h>
#include <welkin/sphere/orientation.h>
#include <welkin/sphere/resample.h>

// welkin convert: an environment from one mapping, layout, orientation, size and file format to another.

namespace welkin {
namespace {

struct ConvertCommand {
  std::string input, output, from, to, size, layout, faults = "repair";
  TextureInput texture;
  double rotate = 0;
  bool mirror = false, mips = false;
};

void warn(const std::string& path, const std::string& message) {
  fmt::print(stderr, "welkin: {}: warning: {}\n", path, message);
}

bool is_texture(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".ktx2" || extension == ".dds";
}

bool writes_six(const ConvertCommand& command) {
  return command.layout == "six" || command.output.find("%s") != std::string::npos;
}

// Before any work: a name that nothing can be written to, and options that say nothing together.
void check_output(const ConvertCommand& command) {
  if (writes_six(command) || !is_texture(command.output)) check_flat_name(command.output);
  if (writes_six(command) && !command.layout.empty() && command.layout != "six")
    throw CLI::ValidationError("--layout", "a %s in the output's name writes six files");
  const std::string extension = extension_of(command.output).substr(1);
  if (is_texture(command.output) || extension == "exr") check_container(command.texture, extension);
  if (command.mips && (!is_texture(command.output) || !command.layout.empty()))
    throw CLI::ValidationError("--mips", "only cubes in .ktx2 and .dds have levels");
}

Mapping named_mapping(const std::string& name) {
  const auto mapping = mapping_from_name(name);
  if (!mapping) throw Error("unknown mapping \"" + name + "\"");
  return *mapping;
}

LoadedImage load_with_warnings(const std::string& path) {
  LoadedImage loaded = load_file_or_sky(path);
  for (const std::string& warning : loaded.warnings) warn(path, warning);
  return loaded;
}

// "sky_%s.hdr" names six faces, in whichever of the three ways of naming has its first file.
SphereMap load_six(const std::string& pattern) {
  for (FaceNames style : {FaceNames::short_signs, FaceNames::long_signs, FaceNames::digits}) {
    const auto names = face_file_names(pattern, style);
    if (!std::filesystem::exists(names[0])) continue;
    std::vector<Image> faces;
    for (const std::string& name : names) {
      LoadedImage loaded = load_with_warnings(name);
      if (loaded.is_cube()) throw Error(name, "is a whole cube, not one face");
      faces.push_back(std::move(loaded.flat));
    }
    return sphere_map_from_cube(cube_from_faces(faces));
  }
  throw Error(pattern, "no faces of that name: %s stands for px, posx or 0 and so on");
}

SphereMap load_flat(const ConvertCommand& command, Image image) {
  if (!command.from.empty() && command.from != "cube") {
    SphereMap map{named_mapping(command.from), std::move(image)};
    check_map_shape(map.shape());
    return map;
  }
  const auto content = guess_flat_content(image.width, image.height);
  if (!content || (command.from == "cube" && !content->layout)) {
    throw Error("a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                " is no layout of a cube and not 2:1; name what it is with --from");
  }
  if (content->layout) return sphere_map_from_cube(cube_from_layout(image, *content->layout));
  return {content->mapping, std::move(image)};
}

SphereMap load_one_file(const ConvertCommand& command) {
  LoadedImage loaded = load_with_warnings(command.input);
  if (loaded.is_cube()) return sphere_map_from_cube(std::move(loaded.cube.levels.front()));
  return load_flat(command, std::move(loaded.flat));
}

// Errors of the readers name their file already, those of the layouts do not.
SphereMap load_any(const ConvertCommand& command) {
  try {
    return command.input.find("%s") != std::string::npos ? load_six(command.input) : load_one_file(command);
  } catch (const Error& error) {
    if (!error.path().empty()) throw;
    throw Error(command.input, error.what());
  }
}

SphereMap load_map(const ConvertCommand& command) {
  SphereMap map = load_any(command);
  const FaultPolicy policy = command.faults == "refuse" ? FaultPolicy::refuse : FaultPolicy::repair;
  const PixelFaults faults = repair_faults(map.image.pixels, policy, command.input);
  if (faults.total() > 0)
    warn(command.input, fmt::format("repaired {} NaN, {} infinite and {} negative values", faults.nan,
                                    faults.infinite, faults.negative));
  return map;
}

Mapping target_mapping(const ConvertCommand& command, const SphereMap& source) {
  if (!command.to.empty()) return named_mapping(command.to);
  return command.layout.empty() && !writes_six(command) ? source.mapping : Mapping::cube;
}

int parse_dimension(const std::string& text, const std::string& whole) {
  int value = 0;
  for (char c : text) {
    if (c < '0' || c > '9' || value > 100'000) value = -1;
    if (value < 0) break;
    value = 10 * value + (c - '0');
  }
  if (value < 1) throw CLI::ValidationError("--size", whole + " is not N or WxH");
  return value;
}

// A quarter of the equator each: a cube of N, an equirectangular map of 4N x 2N, and N of the others in between.
MapShape as_fine_as(const MapShape& source, Mapping mapping) {
  const bool equirect = source.mapping == Mapping::equirectangular, cube = source.mapping == Mapping::cube;
  const int quarter = equirect ? source.width / 4 : cube ? source.width : source.height / 2;
  const int n = std::max(quarter, 1);
  return map_shape(mapping, mapping == Mapping::cube ? n : 2 * n);
}

MapShape parse_shape(const std::string& size, Mapping mapping) {
  const std::size_t cross = size.find('x');
  const int width = parse_dimension(size.substr(0, cross), size);
  if (cross == std::string::npos) return map_shape(mapping, width);
  const int height = parse_dimension(size.substr(cross + 1), size);
  if (mapping == Mapping::cube && width != height)
    throw CLI::ValidationError("--size", "faces of a cube are square");
  return mapping == Mapping::cube ? map_shape(mapping, width) : MapShape{mapping, width, height};
}

// Without --size: the source's shape, or about its number of texels in another mapping.
MapShape target_shape(const ConvertCommand& command, const SphereMap& source) {
  const Mapping mapping = target_mapping(command, source);
  if (command.size.empty())
    return mapping == source.mapping ? source.shape() : as_fine_as(source.shape(), mapping);
  const MapShape shape = parse_shape(command.size, mapping);
  try {
    check_map_shape(shape);
  } catch (const Error& error) {
    throw CLI::ValidationError("--size", error.what());
  }
  return shape;
}

// Texels are moved rather than interpolated wherever that does the job.
SphereMap converted(const ConvertCommand& command, SphereMap map) {
  const MapShape target = target_shape(command, map);
  if (command.mirror) map = mirrored(map);
  if (target.mapping == map.mapping && target.width == map.image.width && target.height == map.image.height) {
    return command.rotate != 0 ? rotated_about_y(map, command.rotate) : map;
  }
  ResampleOptions options;
  options.orientation = rotation_about_y(command.rotate);
  return resample(map, target, options);
}

// Nothing that a format did to the values goes unsaid.
void save_encoded(const std::string& path, const EncodedTexture& texture, bool scale_in_file) {
  write_file(path, texture.bytes);
  if (texture.stored_scale != 1)
    warn(path, fmt::format("values are stored divided by {:g}{}", texture.stored_scale,
                           scale_in_file ? "; the key WelkinStoredScale says so" : ", which DDS cannot say"));
  if (texture.clipped > 0) warn(path, fmt::format("{} values were clipped", texture.clipped));
}

// Cubes and flat images alike.
template <class Texture>
void save_texture(const ConvertCommand& command, const Texture& texture) {
  if (extension_of(command.output) == ".ktx2") {
    Ktx2Options options;
    options.format = command.texture.pixel_format();
    options.quality = command.texture.block_quality();
    save_encoded(command.output, encode_ktx2(texture, options), true);
  } else {
    DdsOptions options;
    options.format = command.texture.pixel_format();
    options.quality = command.texture.block_quality();
    save_encoded(command.output, encode_dds(texture, options), false);
  }
}

bool is_single(const ConvertCommand& command) { return command.texture.format == "rgba32f"; }

// All six appear, or none.
void save_six(const std::string& pattern, const Cube& cube, bool single) {
  const auto names = face_file_names(pattern, FaceNames::short_signs);
  const auto faces = cube_faces(cube);
  std::vector<OutputFile> files;
  for (std::size_t i = 0; i < 6; ++i) files.push_back({names[i], encode_flat(names[i], faces[i], single)});
  write_files(files);
}

void save_flat(const ConvertCommand& command, const Image& image) {
  if (is_texture(command.output)) return save_texture(command, image);
  write_file(command.output, encode_flat(command.output, image, is_single(command)));
}

void save_cube(const ConvertCommand& command, Cube cube) {
  if (writes_six(command)) return save_six(command.output, cube, is_single(command));
  if (command.layout.empty() && is_texture(command.output))
    return save_texture(command, build_mips(std::move(cube), command.mips ? 0 : 1));
  const std::string name = command.layout.empty() ? "hcross" : command.layout;
  save_flat(command, cube_to_layout(cube, cube_layout_from_name(name).value()));
}

void run(const ConvertCommand& command) {
  check_output(command);
  SphereMap source = load_map(command);
  const bool cube = target_mapping(command, source) == Mapping::cube;
  if (!cube && (!command.layout.empty() || writes_six(command) || command.mips))
    throw CLI::ValidationError("--layout, --mips and six files", "are for cubes: say --to cube");
  SphereMap map = converted(command, std::move(source));
  cube ? save_cube(command, cube_from_sphere_map(std::move(map))) : save_flat(command, map.image);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App* sub =
      app.add_subcommand("convert", "Change mapping, layout, size, orientation or format of a map");
  const CLI::IsMember mappings = is_mapping();
  sub->add_option("input", command->input,
                  "A map or sky:...; sky_%s.hdr for six faces px .. nz, posx .. negz or 0 .. 5")
      ->required();
  sub->add_option("-o,--output", command->output, "File to write: .hdr, .exr, .png, .ktx2 or .dds")
      ->required();
  sub->add_option("--from,--mapping", command->from,
                  "What the input shows, where its proportion does not say")
      ->check(mappings);
  sub->add_option("--to", command->to, "Mapping of the output (default: as the input)")->check(mappings);
  sub->add_option("--size", command->size,
                  "N (face, or shorter side) or WxH; default: about as fine as the input");
  sub->add_option("--layout", command->layout, "How a cube lies in a picture")
      ->check(CLI::IsMember({"hcross", "vcross", "hstrip", "vstrip", "six"}));
  sub->add_option("--rotate", command->rotate, "Degrees about +Y, counter-clockwise from above")
      ->check(must_be_finite);
  sub->add_flag("--mirror", command->mirror, "Exchange left and right (z -> -z), before --rotate");
  sub->add_flag("--mips", command->mips, "Write all mip levels of a cube (.ktx2, .dds)");
  add_texture_options(*sub, command->texture, "Texels of .ktx2 and .dds", true);
  sub->add_option("--faults", command->faults, "NaN, infinite and negative values: repair or refuse")
      ->check(CLI::IsMember({"repair", "refuse"}))
      ->capture_default_str();
  sub->footer(
      "Examples:\n  welkin convert park.hdr --to cube --size 512 --mips -o park.ktx2\n"
      "  welkin convert sky_%s.hdr --to equirectangular -o sky.exr");
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
