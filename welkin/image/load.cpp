#include <welkin/image/load.h>

#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/hdr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/file_extension.h>
#include <welkin/image/output_file.h>
#include <welkin/image/tonemap.h>

namespace welkin {
namespace {

LoadedImage decode_radiance(std::span<const std::uint8_t> bytes, std::string_view name) {
  LoadedImage loaded;
  loaded.flat = decode_hdr(bytes, name);
  loaded.format = "Radiance HDR";
  return loaded;
}

struct Format {
  std::string_view magic;
  LoadedImage (*decode)(std::span<const std::uint8_t> bytes, std::string_view name);
};

constexpr Format formats[] = {
    {"#?", decode_radiance},      {"\x76\x2f\x31\x01", decode_exr}, {"\x89PNG", decode_ldr},
    {"\xff\xd8\xff", decode_ldr}, {"\xabKTX 20\xbb", decode_ktx2},  {"DDS ", decode_dds},
};

}  // namespace

LoadedImage decode_image(std::span<const std::uint8_t> bytes, std::string_view name) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Format& format : formats) {
    if (text.starts_with(format.magic)) return format.decode(bytes, name);
  }
  throw Error(name, "not an image that can be read (HDR, EXR, PNG, JPEG, KTX2, DDS)");
}

LoadedImage load_image(const std::filesystem::path& path) {
  return decode_image(read_file(path), path.string());
}

void save_image(const std::filesystem::path& path, const Image& image) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".hdr" || extension == ".pic") {
    write_file(path, encode_hdr(image));
  } else if (extension == ".exr") {
    write_file(path, encode_exr(image));
  } else if (extension == ".png") {
    write_file(path, encode_png(tone_map(image)));
  } else {
    throw Error(path.string(),
                "flat images are written as .hdr, .exr or .png; give the file one of these endings");
  }
}

}  // namespace welkin
