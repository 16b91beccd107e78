#include "cube_file.h"

#include <fmt/format.h>

#include "flat_file.h"

#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/output_file.h>
#include <welkin/sphere/cube_layout.h>

namespace welkin {
namespace {

bool is_texture(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".ktx2" || extension == ".dds";
}

PixelFormat named_format(const std::string& name) {
  for (PixelFormat format : {PixelFormat::rgba16f, PixelFormat::rgba32f, PixelFormat::rgb9e5})
    if (name == pixel_format_name(format)) return format;
  throw Error("unknown format \"" + name + "\"");
}

EncodedTexture encoded(const std::string& path, const CubeMips& cube, PixelFormat format) {
  if (extension_of(path) == ".ktx2") {
    Ktx2Options options;
    options.format = format;
    return encode_ktx2(cube, options);
  }
  DdsOptions options;
  options.format = format;
  return encode_dds(cube, options);
}

}  // namespace

void check_cube_name(const std::string& path) {
  if (!is_texture(path)) check_flat_name(path);
}

void write_cube_file(const std::string& path, const Cube& cube, const CubeFileOptions& options) {
  if (!is_texture(path)) {
    const Image image = cube_to_layout(cube, cube_layout_from_name(options.layout).value());
    return write_file(path, encode_flat(path, image, options.format == "rgba32f"));
  }
  CubeMips one_level;
  one_level.levels.push_back(cube);
  const EncodedTexture texture = encoded(path, one_level, named_format(options.format));
  write_file(path, texture.bytes);
  if (texture.stored_scale != 1)
    fmt::print(stderr, "welkin: {}: warning: values are stored divided by {:g}\n", path,
               texture.stored_scale);
  if (texture.clipped > 0)
    fmt::print(stderr, "welkin: {}: warning: {} values were clipped\n", path, texture.clipped);
}

}  // namespace welkin
