#include <cstring>
#include <locale>
#include <sstream>
#include <vector>

#include <welkin/error.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/codecs/ktx2_format.h>
#include <welkin/image/codecs/ktx2_zstd.h>
#include <welkin/image/codecs/little_endian.h>
#include <welkin/image/codecs/texture_source.h>
#include <welkin/image/codecs/texture_surface.h>

namespace welkin {
namespace {

void check_keys(const std::map<std::string, std::string>& keys) {
  for (const auto& [key, value] : keys) {
    const std::string prefix = key.substr(0, 3);
    if (key.empty() || prefix == "KTX" || prefix == "ktx" || key == ktx2_scale_key) {
      throw Error("the KTX2 key '" + key + "' is empty or reserved");
    }
    if ((key + value).find('\0') != std::string::npos)
      throw Error("the KTX2 key '" + key + "' holds a zero byte");
  }
}

void check_options(const Ktx2Options& options) {
  if (options.zstd_level < 0 || options.zstd_level > 22)
    throw Error("the zstd level must be between 0 and 22");
  check_keys(options.keys);
}

std::string decimal(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << value;
  return text.str();
}

void pad_to(std::vector<std::uint8_t>& bytes, std::size_t alignment) {
  while (bytes.size() % alignment != 0) bytes.push_back(0);
}

// Entries sorted by key (std::map orders by bytes, which for UTF-8 is the order of code points), each with
// its length, the key, a zero byte, the text, a zero byte, and zeros up to a multiple of 4.
std::vector<std::uint8_t> key_value_data(std::map<std::string, std::string> entries, double stored_scale) {
  entries["KTXorientation"] = "rd";
  entries["KTXwriter"] = "welkin 0.1";
  if (stored_scale != 1) entries[std::string(ktx2_scale_key)] = decimal(stored_scale);
  std::vector<std::uint8_t> bytes;
  for (const auto& [key, value] : entries) {
    put_u32(bytes, static_cast<std::uint32_t>(key.size() + 1 + value.size() + 1));
    bytes.insert(bytes.end(), key.begin(), key.end());
    bytes.push_back(0);
    bytes.insert(bytes.end(), value.begin(), value.end());
    bytes.push_back(0);
    pad_to(bytes, 4);
  }
  return bytes;
}

struct EncodedLevel {
  std::vector<std::uint8_t> bytes;
  std::size_t plain_size = 0;
};

std::vector<EncodedLevel> encode_levels(const TextureSource& source, const Ktx2Options& options,
                                        EncodedTexture& texture) {
  SurfaceEncoder encoder(options.format, options.quality, options.shared_edges);
  const auto factor = static_cast<float>(1 / texture.stored_scale);
  std::vector<EncodedLevel> levels;
  for (std::size_t k = 0; k < source.levels.size(); ++k) {
    const SurfaceShape shape = source.shape(k);
    EncodedLevel level;
    level.plain_size = shape.bytes(pixel_layout(options.format));
    level.bytes.resize(level.plain_size);
    texture.clipped += encoder.encode(source.levels[k], shape, source.channels, factor, level.bytes);
    if (options.zstd_level > 0) level.bytes = compress_ktx2_level(level.bytes, options.zstd_level);
    levels.push_back(std::move(level));
  }
  return levels;
}

// Header and level index. The order in the file is: header, level index, data format descriptor, key/value
// data, levels from the smallest to the largest; supercompression global data there is none.
struct Layout {
  std::size_t descriptor_offset = 0, descriptor_size = 0;
  std::size_t keys_offset = 0, keys_size = 0;
  std::vector<std::size_t> level_offsets;
  std::size_t file_size = 0;
};

Layout lay_out(std::size_t descriptor_size, std::size_t keys_size, const std::vector<EncodedLevel>& levels,
               std::size_t alignment) {
  Layout layout;
  layout.descriptor_offset = ktx2_header_size + ktx2_level_entry_size * levels.size();
  layout.descriptor_size = descriptor_size;
  layout.keys_offset = layout.descriptor_offset + descriptor_size;
  layout.keys_size = keys_size;
  layout.file_size = layout.keys_offset + keys_size;
  layout.level_offsets.resize(levels.size());
  for (std::size_t k = levels.size(); k-- > 0;) {
    layout.level_offsets[k] = (layout.file_size + alignment - 1) / alignment * alignment;
    layout.file_size = layout.level_offsets[k] + levels[k].bytes.size();
  }
  return layout;
}

void put_header(std::vector<std::uint8_t>& bytes, const TextureSource& source, const Ktx2Format& format,
                bool supercompressed, const Layout& layout) {
  bytes.insert(bytes.end(), ktx2_identifier.begin(), ktx2_identifier.end());
  put_u32(bytes, format.vk_format);
  put_u32(bytes, format.type_size);
  put_u32(bytes, static_cast<std::uint32_t>(source.width));
  put_u32(bytes, static_cast<std::uint32_t>(source.height));
  put_u32(bytes, 0);  // depth: not a 3-D texture
  put_u32(bytes, 0);  // layers: not an array
  put_u32(bytes, static_cast<std::uint32_t>(source.faces));
  put_u32(bytes, static_cast<std::uint32_t>(source.levels.size()));
  put_u32(bytes, supercompressed ? ktx2_scheme_zstd : ktx2_scheme_none);
  put_u32(bytes, static_cast<std::uint32_t>(layout.descriptor_offset));
  put_u32(bytes, static_cast<std::uint32_t>(layout.descriptor_size));
  put_u32(bytes, static_cast<std::uint32_t>(layout.keys_offset));
  put_u32(bytes, static_cast<std::uint32_t>(layout.keys_size));
  put_u64(bytes, 0);
  put_u64(bytes, 0);
}

void assemble(std::vector<std::uint8_t>& bytes, const TextureSource& source, const Ktx2Format& format,
              bool supercompressed, const std::vector<EncodedLevel>& levels,
              const std::vector<std::uint8_t>& keys) {
  const std::vector<std::uint32_t> descriptor = ktx2_data_format_descriptor(format.layout);
  const Layout layout = lay_out(4 * descriptor.size(), keys.size(), levels,
                                ktx2_level_alignment(format.layout, supercompressed));
  bytes.reserve(layout.file_size);
  put_header(bytes, source, format, supercompressed, layout);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    put_u64(bytes, layout.level_offsets[k]);
    put_u64(bytes, levels[k].bytes.size());
    put_u64(bytes, levels[k].plain_size);
  }
  for (const std::uint32_t word : descriptor) put_u32(bytes, word);
  bytes.insert(bytes.end(), keys.begin(), keys.end());
  for (std::size_t k = levels.size(); k-- > 0;) {
    bytes.resize(layout.level_offsets[k]);  // padding
    bytes.insert(bytes.end(), levels[k].bytes.begin(), levels[k].bytes.end());
  }
}

EncodedTexture encode(const TextureSource& source, const Ktx2Options& options) {
  check_options(options);
  EncodedTexture texture;
  texture.stored_scale = texture_scale(source, options.format, options.range, options.stored_scale);
  const std::vector<EncodedLevel> levels = encode_levels(source, options, texture);
  assemble(texture.bytes, source, ktx2_format(options.format), options.zstd_level > 0, levels,
           key_value_data(options.keys, texture.stored_scale));
  return texture;
}

}  // namespace

EncodedTexture encode_ktx2(const CubeMips& cube, const Ktx2Options& options) {
  return encode(texture_source(cube), options);
}

EncodedTexture encode_ktx2(const Image& image, const Ktx2Options& options) {
  return encode(texture_source(image), options);
}

std::vector<std::uint8_t> encode_ktx2_table(const Image& table,
                                            const std::map<std::string, std::string>& keys) {
  check_keys(keys);
  const TextureSource source = texture_source(table);
  std::vector<EncodedLevel> levels(1);
  levels[0].plain_size = source.levels[0].size_bytes();
  levels[0].bytes.resize(levels[0].plain_size);
  std::memcpy(levels[0].bytes.data(), source.levels[0].data(), levels[0].plain_size);
  std::vector<std::uint8_t> bytes;
  assemble(bytes, source, ktx2_float_format(table.channels), false, levels, key_value_data(keys, 1));
  return bytes;
}

}  // namespace welkin
