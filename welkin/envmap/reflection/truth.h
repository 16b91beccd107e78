#pragma once
#include <functional>
#include <span>
#include <vector>

#include <welkin/brdf/isotropic.h>
#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// A point of a surface as the camera sees it; both unit length, `view` points away from the surface.
struct ReflectionQuery {
  Vec3 normal, view;
};

/// Reflected radiance: the integral over the hemisphere of `normal` of f(light, view) L(light) cos(light), by the sum
/// over every texel of an equirectangular map (3 channels), in double: the oracle of every view-dependent filter.
/// Texels that are wide beside the BRDF's angular width, or that lie across the horizon, are cut into as many parts as
/// it asks for. Returns [query * 3 + channel]; 0 where view lies below the surface. Costs queries * texels.
std::vector<double> reflect_brute_force(const Image& radiance, const IsotropicBrdf& brdf,
                                        std::span<const ReflectionQuery> queries);

/// Random pairs for error measures: normals uniform on the sphere, views uniform in the cosine from the normal over
/// [smallest_cos_view, 1] and in azimuth. The same for the same seed.
std::vector<ReflectionQuery> random_reflection_queries(int count, unsigned seed,
                                                       double smallest_cos_view = 0.05);

/// The queries of a sphere seen from far away: an orthographic picture of size x size: row-major, those outside
/// of the disc have a zero normal. The camera looks along -Z (view = +Z), x to the right, y up.
std::vector<ReflectionQuery> sphere_picture_queries(int size);

}  // namespace welkin
