#pragma once
#include <string>

#include <welkin/scene/scene.h>

// Meshes of simple shapes with normals, tangents along +u, and texture coordinates, and short ways to put things into a
// scene.

namespace welkin {

/// Both return the index of what they added.
int add_material(Scene& scene, Material material);
int add_mesh(Scene& scene, Mesh mesh, int material);

/// Places mesh `mesh`.
void add_instance(Scene& scene, int mesh, const Affine& to_world = {});

/// The parallelogram corner, corner + across, corner + across + up, corner + up, front where cross(across, up) points;
/// u along across, v = 1 at the corner.
Mesh make_rectangle(Vec3f corner, Vec3f across, Vec3f up);

/// All six sides of the box between two corners, front outside; each with its own texture square.
Mesh make_box(Vec3f low, Vec3f high);

/// A point of a lathe's outline: distance from the axis (y) and height, with the outline's outward normal there.
struct OutlinePoint {
  Vec2f position;  ///< x: distance from the axis >= 0; y: height
  Vec2f normal;    ///< unit
};

/// The outline turned about y, `steps` (>= 3) quads around, front on the side of the normals where the outline runs
/// counter-clockwise about its inside (upwards on the outside). A point twice, with two normals, is a crease. u runs around, v = 1 at the outline's first point.
Mesh make_lathe(const std::vector<OutlinePoint>& outline, int steps);

/// A ring about y: tube of radius `minor` around a circle of radius `major`.
Mesh make_torus(float major, float minor, int steps_around, int steps_across);

}  // namespace welkin
