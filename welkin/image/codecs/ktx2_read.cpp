#include <algorithm>
#include <bit>
#include <cmath>
#include <locale>
#include <sstream>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/codecs/ktx2_format.h>
#include <welkin/image/codecs/ktx2_zstd.h>
#include <welkin/image/codecs/little_endian.h>
#include <welkin/image/codecs/size_limit.h>
#include <welkin/image/codecs/texture_surface.h>

namespace welkin {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Keys = std::map<std::string, std::string>;

// A block of 128 KiB that repeats one byte takes 4 bytes: nothing that Zstandard makes is smaller.
constexpr double zstd_bytes_per_byte = 32768;

struct Header {
  std::uint32_t vk_format = 0, width = 0, height = 0, depth = 0, layers = 0, faces = 0, levels = 0,
                scheme = 0;
  std::uint32_t descriptor_offset = 0, descriptor_size = 0, keys_offset = 0, keys_size = 0;
};

// The part [offset, offset + size) of the file, which must be inside it.
Bytes section(Bytes bytes, std::uint64_t offset, std::uint64_t size, std::string_view name,
              const char* what) {
  if (offset > bytes.size() || size > bytes.size() - offset) {
    throw Error(name, std::string("the ") + what +
                          " of this KTX2 file lies beyond its end; it is cut off or damaged");
  }
  return bytes.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
}

Header parse_header(Bytes bytes, std::string_view name) {
  if (bytes.size() < ktx2_identifier.size() ||
      !std::equal(ktx2_identifier.begin(), ktx2_identifier.end(), bytes.begin())) {
    throw Error(name, "not a KTX2 file");
  }
  const Bytes head = section(bytes, 0, ktx2_header_size, name, "header");
  Header header;
  header.vk_format = get_u32(head, 12);
  header.width = get_u32(head, 20);
  header.height = get_u32(head, 24);
  header.depth = get_u32(head, 28);
  header.layers = get_u32(head, 32);
  header.faces = get_u32(head, 36);
  header.levels = std::max(1u, get_u32(head, 40));  // 0 asks the loader to make mip levels: one is stored
  header.scheme = get_u32(head, 44);
  header.descriptor_offset = get_u32(head, 48);
  header.descriptor_size = get_u32(head, 52);
  header.keys_offset = get_u32(head, 56);
  header.keys_size = get_u32(head, 60);
  return header;
}

const Ktx2Format& check_kind(const Header& header, std::size_t file_size, std::string_view name) {
  const Ktx2Format* format = find_ktx2_format(header.vk_format);
  if (format == nullptr) {
    throw Error(name, "KTX2 with VkFormat " + std::to_string(header.vk_format) +
                          " is not read; only half, float, E5B9G9R9, B10G11R11, BC6H and ASTC HDR 4x4 and "
                          "6x6 textures are");
  }
  if (header.scheme != ktx2_scheme_none && header.scheme != ktx2_scheme_zstd) {
    throw Error(name, "KTX2 supercompression scheme " + std::to_string(header.scheme) +
                          " is not read; only none and Zstandard are");
  }
  if (header.depth != 0 || header.layers > 1 || header.height == 0) {
    throw Error(name, "only 2-D and cube KTX2 textures are read, not 1-D, 3-D or arrays");
  }
  if (header.faces != 1 && header.faces != 6)
    throw Error(name, "a KTX2 file has 1 or 6 faces, this says others");
  if (header.faces == 6 && header.width != header.height)
    throw Error(name, "the faces of this KTX2 cube are not square");
  const double stored_per_byte = header.scheme == ktx2_scheme_zstd ? zstd_bytes_per_byte : 1.0;
  const PixelLayout layout = format->layout;
  check_image_size(
      name, header.width, std::int64_t{header.height} * header.faces, file_size,
      stored_per_byte * layout.block_width * layout.block_height / static_cast<double>(layout.bytes()));
  const auto most_levels = static_cast<std::uint32_t>(std::bit_width(std::max(header.width, header.height)));
  if (header.levels > most_levels)
    throw Error(name, "this KTX2 file claims more mip levels than its size has");
  return *format;
}

Keys parse_keys(Bytes data, std::string_view name) {
  Keys keys;
  for (std::size_t at = 0; at < data.size();) {
    if (data.size() - at < 4 || get_u32(data, at) > data.size() - at - 4) {
      throw Error(name, "the key/value data of this KTX2 file is damaged");
    }
    const Bytes entry = data.subspan(at + 4, get_u32(data, at));
    const auto key_end = std::find(entry.begin(), entry.end(), std::uint8_t{0});
    if (key_end == entry.end()) throw Error(name, "a key of this KTX2 file has no end");
    auto value_end = entry.end();
    if (value_end != key_end + 1 && *(value_end - 1) == 0) --value_end;
    keys[std::string(entry.begin(), key_end)] = std::string(key_end + 1, value_end);
    at = std::min(data.size(), (at + 4 + entry.size() + 3) / 4 * 4);
  }
  return keys;
}

float stored_scale(const Keys& keys, std::string_view name) {
  const auto entry = keys.find(std::string(ktx2_scale_key));
  if (entry == keys.end()) return 1;
  std::istringstream text(entry->second);
  text.imbue(std::locale::classic());
  double scale = 0;
  text >> scale;
  if (text.fail() || !(scale >= 0x1p-126 && scale <= 0x1p126)) {
    throw Error(name, "the key WelkinStoredScale of this KTX2 file is not a positive number");
  }
  return static_cast<float>(scale);
}

// The stored bytes of a level; `plain` keeps them where they had to be decompressed.
Bytes level_bytes(Bytes file, const Header& header, std::size_t level, std::size_t expected,
                  std::vector<std::uint8_t>& plain, std::string_view name) {
  const Bytes index =
      section(file, ktx2_header_size, ktx2_level_entry_size * header.levels, name, "level index");
  const std::size_t entry = ktx2_level_entry_size * level;
  const Bytes stored = section(file, get_u64(index, entry), get_u64(index, entry + 8), name, "image data");
  if (get_u64(index, entry + 16) != expected ||
      (header.scheme == ktx2_scheme_none && stored.size() != expected)) {
    throw Error(name, "mip level " + std::to_string(level) + " of this KTX2 file has the wrong size");
  }
  if (header.scheme == ktx2_scheme_none) return stored;
  plain = decompress_ktx2_level(stored, expected, level, name);
  return plain;
}

void turn_upright(Image& image, const std::string& orientation) {
  const auto row = static_cast<std::size_t>(image.width) * image.channels;
  if (orientation.size() > 1 && orientation[1] == 'u') {
    for (int y = 0; y < image.height / 2; ++y) {
      std::swap_ranges(image.at(0, y), image.at(0, y) + row, image.at(0, image.height - 1 - y));
    }
  }
  if (!orientation.empty() && orientation[0] == 'l') {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width / 2; ++x) {
        std::swap_ranges(image.at(x, y), image.at(x, y) + image.channels, image.at(image.width - 1 - x, y));
      }
    }
  }
}

// What the data format descriptor says about colour, where it differs from what we take it for.
void add_colour_warnings(Bytes file, const Header& header, std::string_view name, LoadedImage& image) {
  const Bytes descriptor =
      section(file, header.descriptor_offset, header.descriptor_size, name, "data format descriptor");
  if (descriptor.size() < 28) return;
  const std::uint32_t primaries = descriptor[13], transfer = descriptor[14];
  if (primaries > 1) image.warnings.push_back("its colour primaries are not Rec.709; they are not converted");
  if (transfer > 1) image.warnings.push_back("its transfer function is not linear; it is not undone");
}

}  // namespace

Keys read_ktx2_keys(Bytes bytes, std::string_view name) {
  const Header header = parse_header(bytes, name);
  return parse_keys(section(bytes, header.keys_offset, header.keys_size, name, "key/value data"), name);
}

LoadedImage decode_ktx2(Bytes bytes, std::string_view name) {
  const Header header = parse_header(bytes, name);
  const Ktx2Format& format = check_kind(header, bytes.size(), name);
  Keys keys = read_ktx2_keys(bytes, name);
  const float scale = stored_scale(keys, name);
  const std::string orientation = keys["KTXorientation"];
  LoadedImage image;
  image.format = "KTX2 " + std::string(format.name) + (header.scheme == ktx2_scheme_zstd ? " zstd" : "");
  add_colour_warnings(bytes, header, name, image);
  SurfaceDecoder decoder(format.layout);
  std::vector<std::uint8_t> plain;
  if (header.faces == 1) {
    const SurfaceShape shape{static_cast<int>(header.width), static_cast<int>(header.height), 1};
    const Bytes stored = level_bytes(bytes, header, 0, shape.bytes(format.layout), plain, name);
    image.flat = Image(shape.width, shape.height);
    decoder.decode(stored, shape, scale, image.flat.pixels, name);
    turn_upright(image.flat, orientation);
    return image;
  }
  if (!orientation.empty() && orientation != "rd") {
    image.warnings.push_back("its KTXorientation is not 'rd', which cube maps need; taken as 'rd'");
  }
  if (keys[std::string(ktx2_edge_fixup_key)] == "warp") {
    image.warnings.push_back(
        "its faces are warped for samplers that do not filter across edges (--edge-fixup warp); "
        "read as they lie, its texels are up to half a texel off");
  }
  for (std::uint32_t k = 0; k < header.levels; ++k) {
    const int side = static_cast<int>(std::max(1u, header.width >> k));
    const SurfaceShape shape{side, side, 6};
    const Bytes stored = level_bytes(bytes, header, k, shape.bytes(format.layout), plain, name);
    Cube level(side);
    decoder.decode(stored, shape, scale, level.texels, name);
    image.cube.levels.push_back(std::move(level));
  }
  return image;
}

}  // namespace welkin
