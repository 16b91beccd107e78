#pragma once
#include <vector>

#include <welkin/sphere/vec3.h>

namespace welkin {

/// A texel of an equirectangular map and the part of it that a disc covers.
struct Coverage {
  int x = 0, y = 0;
  double fraction = 0;  // of the texel's solid angle, in (0, 1]
};

/// How much of each texel of a width x height equirectangular map lies within `radius` (radians, < pi/2) of the unit
/// vector `centre` and above the horizon; only texels that are touched. Exact in solid angle to about 1e-9 of the
/// disc, however large or small the texels are: the fractions times the texels' solid angles add up to the disc's.
std::vector<Coverage> disc_coverage(int width, int height, Vec3 centre, double radius);

}  // namespace welkin
