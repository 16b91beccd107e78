#pragma once
#include <string>

#include <welkin/image/codecs/encoded_texture.h>
#include <welkin/image/image.h>

namespace welkin {

struct CubeFileOptions {
  std::string format = "rgba16f";  ///< of .ktx2 and .dds: rgba16f, rgba32f or rgb9e5
  std::string layout = "hcross";   ///< of the others: hcross, vcross, hstrip or vstrip
};

/// Throws Error, before any work, for an extension that write_cube_file cannot write.
void check_cube_name(const std::string& path);

/// One cube: as a cube texture to .ktx2 and .dds, else laid out as a picture. Says on standard error what the format did to
/// the values.
void write_cube_file(const std::string& path, const Cube& cube, const CubeFileOptions& options = {});

}  // namespace welkin
