#pragma once
#include <welkin/sh/projection.h>
#include <welkin/sh/texel_nodes.h>

// Projection of maps of every layout, texel by texel. Coefficients are integrals of L Y_lm over the sphere (radiance,
// not convolved, nothing divided out), each texel a patch of constant radiance.

namespace welkin {

/// TexelRule::integrated is exact for the patches (error < 1e-10 of the largest coefficient): for cubes and dual
/// paraboloids by Gauss nodes in every texel, for equirectangular maps (of 1, 3 or 4 channels) by project_equirect; other mappings throw
/// Error. TexelRule::centre takes every mapping: simple, and off by the curvature of Y_lm within a texel,
/// O((max_degree / size)^2). Cost: texels * nodes * max_degree^2. Throws Error when max_degree is negative or above
/// max_projection_degree, or the map has no valid shape.
ShCoefficients project_map(const SphereMap& radiance, int max_degree, TexelRule rule = TexelRule::integrated);

/// The same for a cube.
ShCoefficients project_cube(const Cube& radiance, int max_degree, TexelRule rule = TexelRule::integrated);

}  // namespace welkin
