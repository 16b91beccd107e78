#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

// The ways to lay the sphere of directions out on a flat grid of texels, behind one set of functions.
//
//   equirectangular  any W x H; see equirect.h.
//   cube             N x 6N: the six faces +X -X +Y -Y +Z -Z below each other, each as in cube.h. This is exactly
//                    how Cube keeps its texels, so a Cube becomes a SphereMap without copying.
//   dual_paraboloid  2N x N (Heidrich and Seidel 1998): left the hemisphere z >= 0, right z < 0. In each square
//                    a = x / (1 + |z|) grows rightwards and b = y / (1 + |z|) grows upwards, both in [-1, 1]; the
//                    hemisphere fills the unit disc. Seen from the inside the left disc is mirrored.
//   mirror_ball      N x N, the sphere map of Haeberli and Segal (1993) and OpenGL: a mirror ball seen from +Z by a
//                    distant viewer. (a, b) = (n.x, n.y) of the ball's normal n = normalize(d + (0, 0, 1)), a
//                    rightwards, b upwards. The middle shows +Z; the whole rim is the one singular direction -Z.
//                    Equal-area: every texel inside the disc has the same solid angle.
//   octahedral       N x N (Praun and Hoppe 2003, Engelhardt and Dachsbacher 2008): d / (|x| + |y| + |z|), seen from
//                    +Y, x rightwards and z downwards; the lower half is folded out to the four corners, which all
//                    are -Y. The border continues on itself: the texel left of (0, j) is (0, N - 1 - j), the one
//                    above (i, 0) is (N - 1 - i, 0), and so on for the other two sides.
//
// Positions are continuous texel coordinates: x in [0, width] rightwards, y in [0, height] downwards; texel (i, j)
// is [i, i + 1) x [j, j + 1), its centre at (i + 1/2, j + 1/2).

namespace welkin {

enum class Mapping { equirectangular, cube, dual_paraboloid, mirror_ball, octahedral };

inline constexpr Mapping all_mappings[] = {Mapping::equirectangular, Mapping::cube, Mapping::dual_paraboloid,
                                           Mapping::mirror_ball, Mapping::octahedral};

/// "equirectangular", "cube", "dual-paraboloid", "mirror-ball" or "octahedral".
std::string_view mapping_name(Mapping mapping);

/// The mapping of a name; also takes the short names equirect, latlong, paraboloid, sphere-map and octa.
std::optional<Mapping> mapping_from_name(std::string_view name);

/// A mapping and the size of its image in texels.
struct MapShape {
  Mapping mapping = Mapping::equirectangular;
  int width = 0, height = 0;
};

/// The shape of a map with `size` texels along its shorter side: 2N x N, N x 6N, 2N x N, N x N, N x N.
MapShape map_shape(Mapping mapping, int size);

/// Throws Error unless width and height are positive, in the mapping's proportion and below 2^31 texels in all.
void check_map_shape(MapShape shape);

/// A position in an image. Charts are the pieces inside which position depends continuously on direction: two
/// positions whose charts differ and are both non-zero lie on different sides of a cut.
struct MapPoint {
  double x = 0, y = 0;
  int chart = 0;
};

/// Where a direction of any length > 0 falls: x in [0, width], y in [0, height].
MapPoint map_point(MapShape shape, Vec3 direction);

/// The unit direction of the point (x + fx, y + fy), with fx and fy in [0, 1], seen as part of texel (x, y): a corner
/// that two cube faces share in the image belongs to the face of the texel. Outside the disc the paraboloids
/// continue into the other hemisphere; the mirror ball stays at -Z.
Vec3 map_texel_direction(MapShape shape, int x, int y, double fx = 0.5, double fy = 0.5);

/// Whether (x + fx, y + fy) shows a direction: false only outside the discs of dual_paraboloid and mirror_ball.
bool map_covers(MapShape shape, int x, int y, double fx = 0.5, double fy = 0.5);

/// The exact solid angle (sr) of the part of texel (x, y) that the mapping covers: a closed form for each mapping
/// (solid_angle.cpp). 0 for a texel outside the discs. All texels together give 4 pi.
double map_texel_solid_angle(MapShape shape, int x, int y);

/// The same for all texels of row y, faster; out gets shape.width values.
void map_row_solid_angles(MapShape shape, int y, std::vector<double>& out);

/// Solid angle per unit of texel area at a point of the sphere (sr per texel), the derivative of the above.
double map_density(MapShape shape, Vec3 unit_direction);

/// An image with what it shows. image.width x image.height is the MapShape.
struct SphereMap {
  Mapping mapping = Mapping::equirectangular;
  Image image;

  MapShape shape() const { return {mapping, image.width, image.height}; }
};

/// Black map of a shape.
SphereMap make_sphere_map(MapShape shape, int channels = 3);

/// The same texels, moved, not copied.
SphereMap sphere_map_from_cube(Cube cube);
/// Needs map.mapping == Mapping::cube.
Cube cube_from_sphere_map(SphereMap map);

}  // namespace welkin
