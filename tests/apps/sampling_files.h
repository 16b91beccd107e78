#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>

#include <welkin/envmap/importance/sampling_table.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/exr_layers.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/image/codecs/ldr.h>
#include <welkin/image/output_file.h>

// Files of `welkin sampling`: maps for it, and its tables with all their channels.

namespace welkin {

inline SamplingTableForm form_from_name(const std::string& name) {
  return name == "rows"  ? SamplingTableForm::rows
         : name == "cdf" ? SamplingTableForm::cdf
                         : SamplingTableForm::alias;
}

/// Single floats: the command gets exactly this map.
inline void write_map(const std::filesystem::path& path, const Image& map) {
  write_file(path, encode_exr(map, {ExrPixelType::single_float, 1}));
}

/// A KTX2 file of single floats, R or RGBA by its VkFormat, as its last bytes are; the reader, which drops alpha, has to
/// accept it and to find the same colours.
inline Image read_ktx2_table(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const Image colours = decode_ktx2(bytes, path.string()).flat;
  std::uint32_t vk_format = 0;
  std::memcpy(&vk_format, bytes.data() + 12, sizeof vk_format);
  EXPECT_TRUE(vk_format == 100 || vk_format == 109)
      << vk_format;  // VK_FORMAT_R32_SFLOAT, R32G32B32A32_SFLOAT
  Image table(colours.width, colours.height, vk_format == 100 ? 1 : 4);
  const std::size_t size = table.pixels.size() * sizeof(float);
  std::memcpy(table.pixels.data(), bytes.data() + bytes.size() - size, size);
  for (int y = 0; y < table.height; ++y)
    for (int x = 0; x < table.width; ++x)
      for (int c = 0; c < 3; ++c)
        EXPECT_EQ(table.at(x, y)[table.channels == 1 ? 0 : c], colours.at(x, y)[c]) << x << " " << y;
  return table;
}

inline Image read_table(const std::filesystem::path& path) {
  if (path.extension() == ".ktx2") return read_ktx2_table(path);
  const ExrLayers layers = decode_exr_layers(read_file(path), path.string());
  EXPECT_EQ(layers.layers.size(), 1u);
  return layers.layers.at(0).image;
}

}  // namespace welkin
