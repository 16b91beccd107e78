#pragma once
#include <span>

#include <welkin/sh/quadric.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// The smallest value of a function of degree 2 on the sphere, where it lies, and the multiplier mu of |n|^2 = 1:
/// A - mu I is positive semidefinite and (A - mu I) n = -b.
struct QuadricMinimum {
  double value = 0;
  Vec3 where{0, 0, 1};
  double multiplier = 0;
};

/// The global minimum over the sphere, exact to rounding: it is a trust-region problem on the sphere, solved by the
/// eigen-decomposition of A and its secular equation (More & Sorensen 1983), hard case included. The value is off by
/// at most about 1e-15 of the largest entry; where minima tie, one of them is returned. Entries are finite.
QuadricMinimum minimize_on_sphere(const SphereQuadric& quadric);

/// The smallest value over the sphere of the function with these nine coefficients in the basis of basis.h, and
/// optionally a direction that has it. Error about 1e-15 of the largest coefficient.
double minimum_degree2(std::span<const double, 9> coefficients, Vec3* where = nullptr);

/// The largest value, likewise.
double maximum_degree2(std::span<const double, 9> coefficients, Vec3* where = nullptr);

}  // namespace welkin
