#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <welkin/envmap/ibl.h>
#include <welkin/envmap/reflection/stretched_taps.h>
#include <welkin/image/codecs/block_quality.h>
#include <welkin/image/packed_formats.h>
#include <welkin/image/range_fit.h>
#include <welkin/sphere/cube_edge_fixup.h>

namespace welkin {

enum class Container { ktx2, dds, exr };

Container parse_container(const std::string& name);
std::string container_name(Container container);

struct IblFileOptions {
  Container container = Container::ktx2;
  PixelFormat format = PixelFormat::rgba16f;  ///< of the cubes; the DFG table is rg16f, or rg32f with rgba32f
  RangePolicy range = RangePolicy::scale;
  int zstd_level = 0;  ///< ktx2 only
  LevelLaw law = LevelLaw::linear;
  const StretchedTapsTable* taps = nullptr;  ///< written too when there
  BlockQuality quality = BlockQuality::normal;
  EdgeFixup edge_fixup = EdgeFixup::none;  ///< of all cubes
};

/// One file of the set, encoded, and what the manifest says of it.
struct IblFile {
  std::string name;
  std::string quantity;  ///< what the numbers are
  std::string unit;
  std::string format;
  std::string quality;  ///< "fast", "normal" or "high" for formats of blocks, else empty
  int size = 0;
  int level_count = 1;
  double stored_scale = 1;  ///< true value = stored value * stored_scale
  std::size_t clipped = 0;  ///< values that the format changed beyond rounding
  std::vector<std::uint8_t> bytes;
};

/// environment, specular, irradiance, dfg, and stretched_taps if asked for, in the container; exr has one file a level, specular_0.exr and so on, six
/// faces side by side in the order +X -X +Y -Y +Z -Z.
std::vector<IblFile> encode_ibl_files(const IblSet& set, const IblFileOptions& options);

}  // namespace welkin
