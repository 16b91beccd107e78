#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/load.h>
#include <welkin/image/output_file.h>
#include <welkin/sphere/cube_layout.h>
#include <welkin/sphere/cube_mips.h>
#include <welkin/sphere/orientation.h>
#include <welkin/sphere/resample.h>

#include "commands.h"

// welkin convert: an environment from one mapping, layout, orientation, size and file format to another.

namespace welkin {
namespace {

struct ConvertCommand {
  std::string input, output, from, to, size, layout, format = "rgba16f";
  double rotate = 0;
  bool mirror = false, mips = false;
};

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

Mapping named_mapping(const std::string& name) {
  const auto mapping = mapping_from_name(name);
  if (!mapping) throw Error("unknown mapping \"" + name + "\"");
  return *mapping;
}

// "sky_%s.hdr" names six faces, in whichever of the three ways of naming has its first file.
SphereMap load_six(const std::string& pattern) {
  for (FaceNames style : {FaceNames::short_signs, FaceNames::long_signs, FaceNames::digits}) {
    const auto names = face_file_names(pattern, style);
    if (!std::filesystem::exists(names[0])) continue;
    std::vector<Image> faces;
    for (const std::string& name : names) faces.push_back(load_image(name).flat);
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

SphereMap load_map(const ConvertCommand& command) {
  if (command.input.find("%s") != std::string::npos) return load_six(command.input);
  LoadedImage loaded = load_image(command.input);
  for (const std::string& warning : loaded.warnings) {
    std::fprintf(stderr, "%s: warning: %s\n", command.input.c_str(), warning.c_str());
  }
  if (loaded.is_cube()) return sphere_map_from_cube(std::move(loaded.cube.levels.front()));
  try {
    return load_flat(command, std::move(loaded.flat));
  } catch (const Error& error) {
    throw Error(command.input, error.what());
  }
}

Mapping target_mapping(const ConvertCommand& command, const SphereMap& source) {
  if (!command.to.empty()) return named_mapping(command.to);
  return command.layout.empty() ? source.mapping : Mapping::cube;
}

int parse_dimension(const std::string& text, const std::string& whole) {
  int value = 0;
  for (char c : text) {
    if (c < '0' || c > '9' || value > 100'000) throw Error("--size " + whole + " is not N or WxH");
    value = 10 * value + (c - '0');
  }
  if (value < 1) throw Error("--size " + whole + " is not N or WxH");
  return value;
}

// Without --size: the source's shape, or about its number of texels in another mapping.
MapShape target_shape(const ConvertCommand& command, const SphereMap& source) {
  const Mapping mapping = target_mapping(command, source);
  if (!command.size.empty()) {
    const std::size_t cross = command.size.find('x');
    if (cross == std::string::npos) return map_shape(mapping, parse_dimension(command.size, command.size));
    const MapShape shape{mapping, parse_dimension(command.size.substr(0, cross), command.size),
                         parse_dimension(command.size.substr(cross + 1), command.size)};
    return mapping == Mapping::cube ? map_shape(mapping, shape.width) : shape;
  }
  if (mapping == source.mapping) return source.shape();
  // A quarter of the equator each: a cube of N, an equirectangular map of 4N x 2N, and N of the others in between.
  const auto quarter = [](MapShape s) {
    if (s.mapping == Mapping::equirectangular) return s.width / 4;
    return s.mapping == Mapping::cube ? s.width : s.height / 2;
  };
  const int n = quarter(source.shape()) > 0 ? quarter(source.shape()) : 1;
  return map_shape(mapping, mapping == Mapping::cube ? n : 2 * n);
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

PixelFormat named_format(const std::string& name) {
  for (PixelFormat format : {PixelFormat::rgba16f, PixelFormat::rgba32f, PixelFormat::rgb9e5}) {
    if (name == pixel_format_name(format)) return format;
  }
  throw Error("unknown --format \"" + name + "\"");
}

void save_encoded(const std::string& path, const EncodedTexture& texture, bool scale_in_file) {
  write_file(path, texture.bytes);
  if (texture.stored_scale != 1 && !scale_in_file) {
    std::fprintf(stderr, "%s: warning: values are stored divided by %g, which DDS cannot say\n", path.c_str(),
                 texture.stored_scale);
  }
}

// Cubes and flat images alike.
template <class Texture>
void save_texture(const ConvertCommand& command, const Texture& texture) {
  if (extension_of(command.output) == ".ktx2") {
    Ktx2Options options;
    options.format = named_format(command.format);
    save_encoded(command.output, encode_ktx2(texture, options), true);
  } else {
    DdsOptions options;
    options.format = named_format(command.format);
    save_encoded(command.output, encode_dds(texture, options), false);
  }
}

void save_cube(const ConvertCommand& command, Cube cube) {
  const std::string extension = extension_of(command.output);
  const bool six = command.layout == "six" || command.output.find("%s") != std::string::npos;
  if (six) {
    const auto names = face_file_names(command.output, FaceNames::short_signs);
    const auto faces = cube_faces(cube);
    for (std::size_t i = 0; i < 6; ++i) save_image(names[i], faces[i]);
  } else if (command.layout.empty() && (extension == ".ktx2" || extension == ".dds")) {
    save_texture(command, build_mips(std::move(cube), command.mips ? 0 : 1));
  } else {
    const std::string name = command.layout.empty() ? "hcross" : command.layout;
    const Image flat = cube_to_layout(cube, cube_layout_from_name(name).value());
    if (extension == ".ktx2" || extension == ".dds") return save_texture(command, flat);
    save_image(command.output, flat);
  }
}

void run(const ConvertCommand& command) {
  SphereMap map = converted(command, load_map(command));
  if (map.mapping == Mapping::cube) return save_cube(command, cube_from_sphere_map(std::move(map)));
  if (!command.layout.empty()) throw Error("--layout is for cubes: say --to cube");
  const std::string extension = extension_of(command.output);
  if (extension == ".ktx2" || extension == ".dds") return save_texture(command, map.image);
  save_image(command.output, map.image);
}

}  // namespace

void add_convert_command(CLI::App& app) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App* sub =
      app.add_subcommand("convert", "Change mapping, layout, size, orientation or format of a map");
  const CLI::IsMember mappings({"equirectangular", "equirect", "latlong", "cube", "dual-paraboloid",
                                "paraboloid", "mirror-ball", "sphere-map", "octahedral", "octa"});
  sub->add_option("input", command->input, "A map; sky_%s.hdr for six faces px .. nz, posx .. negz or 0 .. 5")
      ->required();
  sub->add_option("-o,--output", command->output, "File to write: .hdr, .exr, .png, .ktx2 or .dds")
      ->required();
  sub->add_option("--from", command->from, "What the input shows, where its proportion does not say")
      ->check(mappings);
  sub->add_option("--to", command->to, "Mapping of the output (default: as the input)")->check(mappings);
  sub->add_option("--size", command->size,
                  "N (face, or shorter side) or WxH; default: about as fine as the input");
  sub->add_option("--layout", command->layout, "How a cube lies in a picture")
      ->check(CLI::IsMember({"hcross", "vcross", "hstrip", "vstrip", "six"}));
  sub->add_option("--rotate", command->rotate, "Degrees about +Y, counter-clockwise from above");
  sub->add_flag("--mirror", command->mirror, "Exchange left and right (z -> -z), before --rotate");
  sub->add_flag("--mips", command->mips, "Write all mip levels of a cube (.ktx2, .dds)");
  sub->add_option("--format", command->format, "Texels of .ktx2 and .dds")
      ->check(CLI::IsMember({"rgba16f", "rgba32f", "rgb9e5"}))
      ->capture_default_str();
  sub->callback([command] { run(*command); });
}

}  // namespace welkin
