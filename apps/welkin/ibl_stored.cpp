#include "ibl_stored.h"

#include <welkin/image/codecs/dds.h>
#include <welkin/image/codecs/exr.h>
#include <welkin/image/codecs/ktx2.h>
#include <welkin/sphere/cube_layout.h>

namespace welkin {
namespace {

// All levels of one file, true values.
CubeMips decode_file(const IblFile& file, Container container) {
  if (container == Container::ktx2) return decode_ktx2(file.bytes, file.name).cube;
  if (container == Container::exr)
    return CubeMips{{cube_from_layout(decode_exr(file.bytes, file.name).flat, CubeLayout::horizontal_strip)}};
  CubeMips cube = decode_dds(file.bytes, file.name).cube;
  for (Cube& level : cube.levels)
    for (float& value : level.texels) value *= static_cast<float>(file.stored_scale);
  return cube;
}

// The files of one cube: a single one, or one a level.
CubeMips decode_cube(const std::vector<IblFile>& files, const std::string& content, Container container) {
  CubeMips cube;
  for (const IblFile& file : files) {
    if (file.name.substr(0, file.name.find_first_of("_.")) != content) continue;
    for (Cube& level : decode_file(file, container).levels) cube.levels.push_back(std::move(level));
  }
  return cube;
}

std::vector<StoredErrors> measure(const CubeMips& computed, const std::string& content,
                                  const std::vector<IblFile>& files, const IblFileOptions& options) {
  return stored_errors(decode_cube(files, content, options.container),
                       fix_edges(computed, options.edge_fixup), options.edge_fixup);
}

}  // namespace

StoredSetErrors measure_stored(const IblSet& set, const std::vector<IblFile>& files,
                               const IblFileOptions& options) {
  return {measure(set.specular, "specular", files, options),
          measure(CubeMips{{set.irradiance}}, "irradiance", files, options).front()};
}

}  // namespace welkin
