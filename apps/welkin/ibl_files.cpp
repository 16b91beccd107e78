#include "ibl_files.h"

#include <fmt/format.h>

#include <welkin/error.h>
#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/sphere/cube_layout.h>

namespace welkin {
namespace {

constexpr const char* radiance_unit = "that of the input, W/(sr m^2) for a calibrated map";
constexpr const char* irradiance_unit = "sr times that of the input, W/m^2 for a calibrated map";

struct Content {
  std::string name, quantity, unit;
};

std::string quality_name(BlockQuality quality) {
  return quality == BlockQuality::fast ? "fast" : quality == BlockQuality::high ? "high" : "normal";
}

IblFile describe_file(const Content& content, const std::string& suffix, const IblFileOptions& options,
                      PixelFormat format) {
  IblFile file;
  file.name = content.name + suffix + "." + container_name(options.container);
  file.quantity = content.quantity;
  file.unit = content.unit;
  file.format = pixel_format_name(format);
  if (pixel_layout(format).is_block()) file.quality = quality_name(options.quality);
  return file;
}

void take(IblFile& file, EncodedTexture&& texture) {
  file.bytes = std::move(texture.bytes);
  file.stored_scale = texture.stored_scale;
  file.clipped = texture.clipped;
}

// OpenEXR files have no cube type: each level is a strip of six faces.
void add_exr_levels(const Content& content, const CubeMips& cube, const IblFileOptions& options,
                    std::vector<IblFile>& files) {
  const RangeFit fit = choose_scale(cube, options.format, options.range);
  for (std::size_t k = 0; k < cube.levels.size(); ++k) {
    const std::string suffix = cube.levels.size() > 1 ? fmt::format("_{}", k) : "";
    IblFile file = describe_file(content, suffix, options, options.format);
    const Image strip = cube_to_layout(cube.levels[k], CubeLayout::horizontal_strip);
    const bool half = options.format != PixelFormat::rgba32f;
    file.bytes =
        encode_exr(strip, {half ? ExrPixelType::half_float : ExrPixelType::single_float, fit.stored_scale});
    file.size = cube.levels[k].size;
    file.stored_scale = fit.stored_scale;
    file.clipped = k == 0 ? fit.clipped : 0;
    files.push_back(std::move(file));
  }
}

void add_fixed_cube(const Content& content, const CubeMips& cube, const IblFileOptions& options,
                    std::vector<IblFile>& files) {
  if (options.container == Container::exr) return add_exr_levels(content, cube, options, files);
  IblFile file = describe_file(content, "", options, options.format);
  if (options.container == Container::ktx2) {
    Ktx2Options ktx{options.format,
                    options.range,
                    0,
                    options.zstd_level,
                    {{"WelkinQuantity", content.quantity}},
                    options.quality,
                    options.edge_fixup != EdgeFixup::none};
    if (options.edge_fixup != EdgeFixup::none)
      ktx.keys[std::string(ktx2_edge_fixup_key)] = std::string(edge_fixup_name(options.edge_fixup));
    if (content.name == "specular") ktx.keys["WelkinLevelLaw"] = std::string(formula(options.law));
    take(file, encode_ktx2(cube, ktx));
  } else {
    take(file, encode_dds(cube, {options.format, options.range, 0, options.quality,
                                 options.edge_fixup != EdgeFixup::none}));
  }
  file.size = cube.size();
  file.level_count = static_cast<int>(cube.levels.size());
  files.push_back(std::move(file));
}

void add_cube(const Content& content, const CubeMips& cube, const IblFileOptions& options,
              std::vector<IblFile>& files) {
  if (options.edge_fixup == EdgeFixup::none) return add_fixed_cube(content, cube, options, files);
  add_fixed_cube(content, fix_edges(cube, options.edge_fixup), options, files);
}

// A flat table of two channels; exr has a third, zero.
void add_table(const Content& content, const Image& table, const IblFileOptions& options,
               std::vector<IblFile>& files) {
  const bool wide = options.format == PixelFormat::rgba32f;
  const PixelFormat format = wide ? PixelFormat::rg32f : PixelFormat::rg16f;
  IblFile file = describe_file(content, "", options, format);
  switch (options.container) {
    case Container::ktx2:
      take(file, encode_ktx2(table, {format, RangePolicy::clip, 0, options.zstd_level, {}, {}, false}));
      break;
    case Container::dds: take(file, encode_dds(table, {format, RangePolicy::clip, 0, {}, false})); break;
    case Container::exr: {
      Image rgb(table.width, table.height);
      for (std::size_t i = 0; i < table.pixels.size(); ++i) rgb.pixels[i / 2 * 3 + i % 2] = table.pixels[i];
      file.bytes = encode_exr(rgb, {wide ? ExrPixelType::single_float : ExrPixelType::half_float, 1});
      break;
    }
  }
  file.size = table.width;
  files.push_back(std::move(file));
}

void add_dfg(const DfgTable& table, const IblFileOptions& options, std::vector<IblFile>& files) {
  Image image(table.size, table.size, 2);
  image.pixels = table.scale_bias;
  add_table(
      {"dfg", "split-sum scale (R) and bias (G): reflectance = F0 * R + G; x = n.v, y = perceptual_roughness",
       "1"},
      image, options, files);
}

void add_stretched_taps(const StretchedTapsTable& table, const IblFileOptions& options,
                        std::vector<IblFile>& files) {
  add_table(
      {"stretched_taps",
       fmt::format("{} look-ups of specular: per look-up {} rows of offset (R) and perceptual_roughness "
                   "(G), then {} of scale (R) and bias (G); x = sqrt(n.v), y = perceptual_roughness",
                   table.taps, table.roughness_size, table.roughness_size),
       "1"},
      stretched_taps_image(table), options, files);
}

}  // namespace

Container parse_container(const std::string& name) {
  for (Container c : {Container::ktx2, Container::dds, Container::exr})
    if (name == container_name(c)) return c;
  throw Error("unknown container '" + name + "'; choose ktx2, dds or exr");
}

std::string container_name(Container container) {
  switch (container) {
    case Container::dds: return "dds";
    case Container::exr: return "exr";
    default: return "ktx2";
  }
}

std::vector<IblFile> encode_ibl_files(const IblSet& set, const IblFileOptions& options) {
  std::vector<IblFile> files;
  add_cube({"environment", "radiance", radiance_unit}, set.environment, options, files);
  add_cube({"specular", "prefiltered radiance, kernel normalised to 1", radiance_unit}, set.specular, options,
           files);
  add_cube({"irradiance", "irradiance E (divide by pi for the radiance of a white diffuse surface)",
            irradiance_unit},
           CubeMips{{set.irradiance}}, options, files);
  add_dfg(set.dfg, options, files);
  if (options.taps) add_stretched_taps(*options.taps, options, files);
  return files;
}

}  // namespace welkin
