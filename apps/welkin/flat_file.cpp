#include "flat_file.h"

#include <fmt/format.h>

#include <filesystem>

#include <welkin/envmap/sky/sky.h>
#include <welkin/error.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/faults.h>
#include <welkin/image/file_extension.h>
#include <welkin/image/load.h>
#include <welkin/image/range_fit.h>
#include <welkin/image/tonemap.h>

namespace welkin {
namespace {

bool is_radiance(const std::string& extension) { return extension == ".hdr" || extension == ".pic"; }

std::vector<std::uint8_t> encode_radiance(const std::string& path, const Image& image) {
  const PixelFaults faults = count_faults(image.pixels);
  if (faults.negative > 0)
    fmt::print(stderr,
               "welkin: {}: warning: {} negative values became 0, which is the least that .hdr can hold\n",
               path, faults.negative);
  return encode_hdr(image);
}

std::vector<std::uint8_t> encode_openexr(const Image& image, bool single) {
  const bool half = !single && largest_storable(image.pixels, PixelFormat::rgba32f) <=
                                   pixel_format_max(PixelFormat::rgba16f);
  return encode_exr(image, {half ? ExrPixelType::half_float : ExrPixelType::single_float, 1});
}

}  // namespace

LoadedImage load_file_or_sky(const std::string& name) {
  if (!is_sky_spec(name)) return load_image(name);
  LoadedImage loaded;
  loaded.format = "sky";
  loaded.flat = make_sky(parse_sky(name));
  return loaded;
}

void check_output(const std::string& path, const std::string& input) {
  if (path.empty()) return;
  std::error_code none;
  if (std::filesystem::equivalent(path, input, none) && std::filesystem::is_regular_file(input, none))
    throw Error(path, "is the input and would be overwritten; choose another name");
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (!std::filesystem::is_directory(folder, none))
    throw Error(path, "cannot be written: there is no folder " + folder.string());
}

std::string extension_of(const std::string& path) { return lower_case_extension(path); }

void check_flat_name(const std::string& path) {
  const std::string extension = extension_of(path);
  if (!is_radiance(extension) && extension != ".exr" && extension != ".png")
    throw Error(path, "flat images are written as .hdr, .exr or .png; give the file one of these endings");
}

std::vector<std::uint8_t> encode_flat(const std::string& path, const Image& image, bool single) {
  check_flat_name(path);
  const std::string extension = extension_of(path);
  if (is_radiance(extension)) return encode_radiance(path, image);
  return extension == ".exr" ? encode_openexr(image, single) : encode_png(tone_map(image));
}

}  // namespace welkin
