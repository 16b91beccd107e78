#pragma once
#include <welkin/sphere/mapping.h>
#include <welkin/sphere/mat3.h>

// Turning and mirroring environments.

namespace welkin {

/// Rotation about +Y by the right-hand rule, counter-clockwise seen from above: +X goes to -Z at 90 degrees. An
/// equirectangular picture moves to the left by degrees / 360 of its width. Throws Error when degrees is not finite.
Mat3 rotation_about_y(double degrees);

/// Reflection z -> -z.
Mat3 mirror_matrix();

/// The map with what it shows in direction d moved to rotation * d (any orthogonal matrix). Throws Error when the
/// matrix is not orthogonal to 1e-6. Resamples.
SphereMap oriented(const SphereMap& map, const Mat3& orientation);

/// oriented() by rotation_about_y, but texels are only moved, bit for bit, where the turn takes the grid to itself:
/// an equirectangular map by a whole number of texels, a cube or an octahedral map by quarter turns. Throws Error when
/// degrees is not finite.
SphereMap rotated_about_y(const SphereMap& map, double degrees);

/// Left and right exchanged, as in a mirror that stands along the X axis: z -> -z. An equirectangular picture is
/// flipped left to right about its middle column, which keeps looking along +X. Bit for bit except for the
/// mirror ball, whose grid has no such symmetry.
SphereMap mirrored(const SphereMap& map);

}  // namespace welkin
