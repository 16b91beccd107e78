#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <welkin/scene/file_resolver.h>
#include <welkin/scene/mtl.h>

namespace welkin {

/// A corner of a face: indices from 0, -1 for none.
struct ObjCorner {
  std::int32_t position = -1, texcoord = -1, normal = -1;
};

/// A polygon: corners [first, next face's first).
struct ObjFace {
  std::uint32_t first = 0;
  std::int32_t object = 0;           ///< into ObjFile::objects
  std::int32_t material = -1;        ///< into the scene's materials
  std::int32_t smoothing_group = 0;  ///< 0: flat
};

/// An OBJ file as its lines say it: all indices in range, all numbers finite.
struct ObjFile {
  std::vector<Vec3f> positions, normals;
  std::vector<Vec2f> texcoords;  ///< v as in glTF: downwards
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  std::vector<std::string> objects;  ///< names
};

/// Materials, textures and warnings go to the scene.
ObjFile parse_obj(std::string_view text, std::string_view name, const FileResolver& resolve, Scene& scene);

}  // namespace welkin
