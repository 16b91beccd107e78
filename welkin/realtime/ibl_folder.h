#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <welkin/realtime/technique.h>

namespace welkin {

/// What a set that `welkin ibl` wrote is to the renderer.
struct IblFolder {
  std::shared_ptr<const EnvironmentData> light;
  std::vector<std::string> warnings;  ///< what the set says and the renderer does not show, one line each
};

/// Whether a path is a folder with a manifest.json.
bool is_ibl_folder(const std::filesystem::path& path);

/// Reads a set, going by its manifest.json: ktx2, dds or exr, any format (BC6H and ASTC are decoded here), any scale and
/// any level law. Nothing is filtered again. Two things are made from what is there: the equirectangular radiance that some
/// techniques and the truth need, from the cube of the environment (twice as fine as its faces, at most 2048 wide), and a
/// DFG table, where the set's has the light between facets in it, which materials of the renderer add themselves.
/// Throws Error naming the folder or the file: something missing or damaged, a specular map of another kernel than ggx,
/// one level only, faces whose texels were moved (--edge-fixup warp).
IblFolder load_ibl_folder(const std::filesystem::path& folder);

}  // namespace welkin
