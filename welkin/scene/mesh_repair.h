#pragma once
#include <cstddef>

#include <welkin/scene/scene.h>

// What every importer does to a mesh before it hands it out.

namespace welkin {

/// Of meshes in files that name none (glTF has its own): gray, half glossy, no metal.
Material default_import_material();

/// What was wrong with meshes, counted.
struct MeshRepairs {
  std::size_t flat_triangles = 0;  ///< without area: dropped
  std::size_t bad_normals = 0;     ///< not a direction: replaced by that of a triangle
  std::size_t bad_tangents = 0;    ///< not a direction: replaced by any

  void add_warnings(std::vector<std::string>& warnings) const;
};

/// Drops triangles without area, brings normals and tangents to unit length and signs to +1 or -1. The mesh must be
/// whole: equal lengths, indices in range, positions finite.
void repair_mesh(Mesh& mesh, MeshRepairs& repairs);

/// Tangents along +u of texcoords[texcoord]: at each vertex the mean over its triangles, by area, of the direction in
/// which u grows; vertices whose triangles disagree about the handedness of the texture are doubled. Not MikkTSpace,
/// which weighs by angle and shares between vertices of equal position: maps baked for that show faint seams. Does
/// nothing to a mesh that has tangents or lacks the texture coordinates.
void make_tangents(Mesh& mesh, int texcoord);

}  // namespace welkin
