#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include <welkin/brdf/lafortune.h>
#include <welkin/envmap/reflection/stack_files.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

// Lafortune's lobes under an environment (McAllister, Lastra & Heidrich 2002): one set of maps, filtered with cos^N for
// a row of exponents N as mip levels, serves every lobe of every texel of a surface. For the view v in the frame of the
// surface, r = (Cx vx, Cy vy, Cz vz),
//   reflected = sum over lobes of scale (N + 2) / (2 pi) |r|^N (n.r) integral of (r.l)^N L(l) dl,  |r| = 1 in the last
// two factors: n.l is taken out of the integral as n.r, as published. That is good for sharp lobes and crude for wide
// ones, and lobes near the horizon reach below it; docs/reflection.md has the errors.

namespace welkin {

struct LafortuneStackOptions {
  double largest_exponent = 1024;  ///< of level 0, 1 to 65536; sharper lobes get level 0
  int size = 0;  ///< texels along an edge of level 0, 4 to 2048; 0: the size that its exponent needs
};

struct LafortuneStack {
  CubeMips glossy;  ///< level k: the kernel phong exponents[k], normalised (a constant passes unchanged)
  std::vector<double> exponents;  ///< falls by 4 a level down to 1; 0 at the last, the mean over a hemisphere
  Cube diffuse;                   ///< irradiance / pi
};

/// Throws Error for options out of range. radiance: equirectangular, 3 channels, finite and >= 0.
LafortuneStack prepare_lafortune_stack(const Image& radiance, const LafortuneStackOptions& options = {});

/// The (fractional) level that stands for cos^N: between two levels the share makes the mean cosine of the blend,
/// (N + 1) / (N + 2), right, so that degree 1 is filtered exactly.
double lafortune_level(const LafortuneStack& stack, double exponent);

/// A point of a surface with a direction along its grain (x of the BRDF's frame), perpendicular to the normal, unit.
struct TangentQuery {
  Vec3 normal, tangent, view;
};

/// Reflected radiance; 0 where the view lies below the surface.
std::array<double, 3> reflect(const LafortuneStack& stack, const LafortuneBrdf& brdf,
                              const TangentQuery& query);

/// The same with a tangent of its own choice: for isotropic BRDFs.
std::array<double, 3> reflect(const LafortuneStack& stack, const LafortuneBrdf& brdf,
                              const ReflectionQuery& query);

/// The full integral, cosine inside and light from above the surface alone, by the sum over every texel in double; each
/// texel is cut into as many parts as the sharpest lobe needs (at least 2 x 2). Returns [query * 3 + channel].
std::vector<double> reflect_lafortune_brute_force(const Image& radiance, const LafortuneBrdf& brdf,
                                                  std::span<const TangentQuery> queries);

/// The queries with tangents turned about the normal by an angle that differs from query to query.
std::vector<TangentQuery> with_tangents(std::span<const ReflectionQuery> queries);

/// "glossy" with its levels and "diffuse"; the description has the exponents.
StackFiles stack_files(const LafortuneStack& stack);

}  // namespace welkin
