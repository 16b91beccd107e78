#include <welkin/image/codecs/dds.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include <welkin/error.h>
#include <welkin/image/codecs/little_endian.h>
#include <welkin/image/codecs/size_limit.h>
#include <welkin/image/codecs/texture_source.h>
#include <welkin/image/codecs/texture_surface.h>

namespace welkin {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Component = PixelLayout::Component;

constexpr std::uint32_t magic = 0x20534444;        // "DDS "
constexpr std::uint32_t dx10_fourcc = 0x30315844;  // "DX10"
constexpr std::size_t header_size = 128, dx10_header_size = 148;

// Byte offsets from the start of the file.
constexpr std::size_t at_size = 4, at_height = 12, at_width = 16, at_levels = 28, at_format_size = 76,
                      at_format_flags = 80, at_fourcc = 84, at_caps2 = 112, at_dxgi = 128, at_dimension = 132,
                      at_misc = 136, at_array = 140;

constexpr std::uint32_t flag_caps = 0x1, flag_height = 0x2, flag_width = 0x4, flag_pitch = 0x8,
                        flag_pixel_format = 0x1000, flag_levels = 0x20000, flag_linear_size = 0x80000;
constexpr std::uint32_t format_has_fourcc = 0x4;
constexpr std::uint32_t caps_complex = 0x8, caps_texture = 0x1000, caps_levels = 0x400000;
constexpr std::uint32_t caps2_cube = 0x200, caps2_all_faces = 0xfc00, caps2_volume = 0x200000;
constexpr std::uint32_t dimension_2d = 3, misc_cube = 0x4;

struct DdsFormat {
  std::uint32_t dxgi, fourcc;  // 0 where there is none
  PixelLayout layout;
  std::string_view name;
};

// Those we write come first, in the order of PixelFormat; ASTC, which DDS has no number for, ends it.
constexpr std::array<DdsFormat, 9> formats = {{
    {10, 113, {Component::half, 4}, "RGBA16F"},
    {2, 116, {Component::float32, 4}, "RGBA32F"},
    {67, 0, {Component::shared_exponent, 3}, "RGB9E5"},
    {34, 112, {Component::half, 2}, "RG16F"},
    {16, 115, {Component::float32, 2}, "RG32F"},
    {26, 0, {Component::small_floats, 3}, "R11G11B10F"},
    {95, 0, {Component::bc6h_unsigned, 3, 4, 4}, "BC6H"},
    {96, 0, {Component::bc6h_signed, 3, 4, 4}, "BC6H signed"},
    {6, 0, {Component::float32, 3}, "RGB32F"},
}};

// Bytes of a row, or of the whole largest level where there are blocks.
std::uint32_t pitch(const TextureSource& source, PixelLayout layout) {
  return static_cast<std::uint32_t>(layout.image_bytes(source.width, layout.is_block() ? source.height : 1));
}

void put_header(std::vector<std::uint8_t>& bytes, const TextureSource& source, const DdsFormat& format) {
  const bool cube = source.faces == 6, mips = source.levels.size() > 1;
  put_u32(bytes, magic);
  put_u32(bytes, 124);
  put_u32(bytes, flag_caps | flag_height | flag_width | flag_pixel_format | (mips ? flag_levels : 0) |
                     (format.layout.is_block() ? flag_linear_size : flag_pitch));
  put_u32(bytes, static_cast<std::uint32_t>(source.height));
  put_u32(bytes, static_cast<std::uint32_t>(source.width));
  put_u32(bytes, pitch(source, format.layout));
  put_u32(bytes, 0);  // depth
  put_u32(bytes, static_cast<std::uint32_t>(source.levels.size()));
  bytes.resize(at_format_size);  // reserved
  put_u32(bytes, 32);
  put_u32(bytes, format_has_fourcc);
  put_u32(bytes, dx10_fourcc);
  bytes.resize(bytes.size() + 20);  // bit count and masks, which DX10 replaces
  put_u32(bytes, caps_texture | (cube || mips ? caps_complex : 0) | (mips ? caps_levels : 0));
  put_u32(bytes, cube ? caps2_cube | caps2_all_faces : 0);
  bytes.resize(header_size);
  put_u32(bytes, format.dxgi);
  put_u32(bytes, dimension_2d);
  put_u32(bytes, cube ? misc_cube : 0);
  put_u32(bytes, 1);  // one texture (one cube), not an array
  put_u32(bytes, 0);  // alpha mode unknown: older readers accept nothing else
}

EncodedTexture encode(const TextureSource& source, const DdsOptions& options) {
  if (pixel_layout(options.format).component == Component::astc_hdr)
    throw Error("DDS has no ASTC; choose bc6h or another container");
  const DdsFormat& format = formats.at(static_cast<std::size_t>(options.format));
  SurfaceEncoder encoder(options.format, options.quality, options.shared_edges);
  EncodedTexture texture;
  texture.stored_scale = texture_scale(source, options.format, options.range, options.stored_scale);
  const auto factor = static_cast<float>(1 / texture.stored_scale);
  std::vector<std::vector<std::uint8_t>> levels;
  for (std::size_t k = 0; k < source.levels.size(); ++k) {
    levels.emplace_back(source.shape(k).bytes(format.layout));
    texture.clipped +=
        encoder.encode(source.levels[k], source.shape(k), source.channels, factor, levels.back());
  }
  put_header(texture.bytes, source, format);
  const auto faces = static_cast<std::size_t>(source.faces);
  for (std::size_t face = 0; face < faces; ++face)
    for (const auto& level : levels) {
      const auto begin = level.begin() + static_cast<std::ptrdiff_t>(face * (level.size() / faces));
      texture.bytes.insert(texture.bytes.end(), begin,
                           begin + static_cast<std::ptrdiff_t>(level.size() / faces));
    }
  return texture;
}

struct Header {
  std::uint32_t width = 0, height = 0, levels = 1;
  bool cube = false;
  const DdsFormat* format = nullptr;
  std::size_t data_offset = header_size;
};

const DdsFormat* find_format(std::uint32_t number, std::uint32_t DdsFormat::*field) {
  const auto found = std::find_if(formats.begin(), formats.end(), [&](const DdsFormat& format) {
    return number != 0 && format.*field == number;
  });
  return found == formats.end() ? nullptr : &*found;
}

void parse_dx10(Bytes bytes, std::string_view name, Header& header) {
  if (bytes.size() < dx10_header_size) throw Error(name, "this DDS file is cut off in its header");
  if (get_u32(bytes, at_dimension) != dimension_2d)
    throw Error(name, "only 2-D and cube DDS textures are read");
  if (get_u32(bytes, at_array) > 1) throw Error(name, "DDS texture arrays are not read");
  header.cube = (get_u32(bytes, at_misc) & misc_cube) != 0;
  header.format = find_format(get_u32(bytes, at_dxgi), &DdsFormat::dxgi);
  header.data_offset = dx10_header_size;
  if (header.format == nullptr) {
    throw Error(name, "DDS with DXGI format " + std::to_string(get_u32(bytes, at_dxgi)) +
                          " is not read; only half, float, R9G9B9E5, R11G11B10 and BC6H textures are");
  }
}

void parse_legacy(Bytes bytes, std::string_view name, Header& header) {
  const std::uint32_t caps2 = get_u32(bytes, at_caps2);
  if ((caps2 & caps2_volume) != 0) throw Error(name, "DDS volume textures are not read");
  header.cube = (caps2 & caps2_cube) != 0;
  if (header.cube && (caps2 & caps2_all_faces) != caps2_all_faces) {
    throw Error(name, "this DDS cube map does not have all six faces");
  }
  const bool fourcc = (get_u32(bytes, at_format_flags) & format_has_fourcc) != 0;
  header.format = fourcc ? find_format(get_u32(bytes, at_fourcc), &DdsFormat::fourcc) : nullptr;
  if (header.format == nullptr) {
    throw Error(name, "this DDS file's pixel format is not read; only half, float and R9G9B9E5 textures are");
  }
}

Header parse_header(Bytes bytes, std::string_view name) {
  if (bytes.size() < 4 || get_u32(bytes, 0) != magic) throw Error(name, "not a DDS file");
  if (bytes.size() < header_size) throw Error(name, "this DDS file is cut off in its header");
  if (get_u32(bytes, at_size) != 124 || get_u32(bytes, at_format_size) != 32) {
    throw Error(name, "the header of this DDS file is damaged");
  }
  Header header;
  header.width = get_u32(bytes, at_width);
  header.height = get_u32(bytes, at_height);
  header.levels = std::max(1u, get_u32(bytes, at_levels));
  const bool dx10 = get_u32(bytes, at_fourcc) == dx10_fourcc;
  dx10 ? parse_dx10(bytes, name, header) : parse_legacy(bytes, name, header);
  if (header.cube && header.width != header.height)
    throw Error(name, "the faces of this DDS cube are not square");
  const PixelLayout layout = header.format->layout;
  check_image_size(name, header.width, std::int64_t{header.height} * (header.cube ? 6 : 1), bytes.size(),
                   layout.block_width * layout.block_height / static_cast<double>(layout.bytes()));
  if (header.levels > static_cast<std::uint32_t>(std::bit_width(std::max(header.width, header.height)))) {
    throw Error(name, "this DDS file claims more mip levels than its size has");
  }
  return header;
}

// One level of one face.
SurfaceShape level_shape(const Header& header, std::uint32_t level) {
  return {static_cast<int>(std::max(1u, header.width >> level)),
          static_cast<int>(std::max(1u, header.height >> level)), 1};
}

std::size_t level_bytes(const Header& header, std::uint32_t level) {
  return level_shape(header, level).bytes(header.format->layout);
}

}  // namespace

EncodedTexture encode_dds(const CubeMips& cube, const DdsOptions& options) {
  return encode(texture_source(cube), options);
}

EncodedTexture encode_dds(const Image& image, const DdsOptions& options) {
  return encode(texture_source(image), options);
}

LoadedImage decode_dds(Bytes bytes, std::string_view name) {
  const Header header = parse_header(bytes, name);
  std::size_t face_bytes = 0;
  for (std::uint32_t k = 0; k < header.levels; ++k) face_bytes += level_bytes(header, k);
  const std::size_t needed = face_bytes * (header.cube ? 6 : 1);
  if (needed > bytes.size() - header.data_offset)
    throw Error(name, "this DDS file is cut off: pixels are missing");
  const Bytes data = bytes.subspan(header.data_offset);
  LoadedImage image;
  image.format = "DDS " + std::string(header.format->name);
  SurfaceDecoder decoder(header.format->layout);
  if (!header.cube) {
    image.flat = Image(static_cast<int>(header.width), static_cast<int>(header.height));
    decoder.decode(data.first(level_bytes(header, 0)), level_shape(header, 0), 1, image.flat.pixels, name);
    return image;
  }
  std::size_t offset = 0;  // of the level inside each face's part
  for (std::uint32_t k = 0; k < header.levels; ++k) {
    Cube level(static_cast<int>(std::max(1u, header.width >> k)));
    const std::size_t values = level.texels.size() / 6, size = level_bytes(header, k);
    for (std::size_t face = 0; face < 6; ++face) {
      decoder.decode(data.subspan(face * face_bytes + offset, size), level_shape(header, k), 1,
                     std::span(level.texels).subspan(face * values, values), name);
    }
    offset += size;
    image.cube.levels.push_back(std::move(level));
  }
  return image;
}

}  // namespace welkin
