#pragma once
#include <welkin/sh/projection.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

inline constexpr int max_minimum_search_degree = 16;

/// A smallest value over the sphere and a direction that has it.
struct SphereMinimum {
  double value = 0;
  Vec3 where{0, 0, 1};
};

/// The minimum of one channel of a function of degree d <= max_minimum_search_degree, by search. The sphere is sampled with
/// every point within 0.5/d rad of a sample; by Bernstein's inequality the second derivative along any great circle is
/// at most d^2/2 of the function's range, so the sample next to the global minimum lies at most 7 % of the range above the
/// lowest sample, and Newton's method is started from all samples that low, except those within 0.5/d rad of a
/// minimum already found. So the result is the global minimum, to 1e-13 of the largest coefficient, unless another
/// minimum less than 1/d rad from it was found in its place. An upper bound of the minimum always. (For degree 2 there is
/// the exact minimum_degree2.) Throws Error when the coefficients are malformed or not finite, or the degree or the
/// channel is out of range.
SphereMinimum find_minimum(const ShCoefficients& function, int channel = 0);

}  // namespace welkin
