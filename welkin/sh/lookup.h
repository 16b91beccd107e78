#pragma once
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sh/texel_nodes.h>

// Look-up tables for projection and its inverse, complete and plain, as King 2005 describes them ("Real-Time
// Computation of Dynamic Irradiance Environment Maps", GPU Gems 2, section 10.3): one number per texel and function.
// Coefficients are those of project_map. folded_lookup.h does the same many times faster; this is what it is tested
// against, and what a shader would hold. (King's texel solid angle 4 / (x^2 + y^2 + z^2)^(3/2) is that of a whole
// face [-1, 1]^2 and lacks 1/size^2; here solid angles are exact.)

namespace welkin {

/// The largest degree of the tables here and in folded_lookup.h.
inline constexpr int max_lookup_degree = 8;

/// values[i * width * height + y * width + x] = Y_i times solid angle of texel (x, y), by a TexelRule. i as sh_index.
struct ShProjectionLookup {
  MapShape shape;
  int max_degree = 0;
  std::vector<float> values;
};

/// TexelRule::centre takes every mapping, TexelRule::integrated cubes and dual paraboloids. Throws Error for other
/// mappings and for degrees outside 0 .. max_lookup_degree.
ShProjectionLookup make_sh_projection_lookup(MapShape shape, int max_degree = 2,
                                             TexelRule rule = TexelRule::centre);

/// One dot product over all texels per coefficient and channel, summed in double. The map's shape must be that of the
/// table, else throws Error.
ShCoefficients project(const ShProjectionLookup& lookup, const SphereMap& radiance);
ShCoefficients project(const ShProjectionLookup& lookup, const Cube& radiance);

/// values[i * width * height + y * width + x] = Y_i in the direction of the centre of texel (x, y).
struct ShSynthesisLookup {
  MapShape shape;
  int max_degree = 0;
  std::vector<float> values;
};

/// Every mapping; degrees 0 .. max_lookup_degree, else throws Error.
ShSynthesisLookup make_sh_synthesis_lookup(MapShape shape, int max_degree = 2);

/// The function at all texel centres; whatever the coefficients are of (irradiance, say). Degrees above
/// lookup.max_degree are left out. Texels outside the discs of a map are where the mapping continues.
SphereMap synthesize(const ShSynthesisLookup& lookup, const ShCoefficients& coefficients);

}  // namespace welkin
