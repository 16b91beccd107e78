#pragma once
#include <span>

#include <welkin/sphere/vec3.h>

namespace welkin {

/// A real function of degree 2 on the sphere as a polynomial: q(n) = n^T A n + 2 b.n + c for unit n, with A symmetric
/// and trace-free (a trace would be a second constant, since |n| = 1).
struct SphereQuadric {
  double xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;  // A
  Vec3 b;
  double c = 0;
};

/// From the nine coefficients in the basis of basis.h, and back: the same function, to rounding.
SphereQuadric quadric_from_sh(std::span<const double, 9> coefficients);
void sh_from_quadric(const SphereQuadric& quadric, std::span<double, 9> coefficients);

/// q(n); n is unit length.
double evaluate(const SphereQuadric& quadric, Vec3 n);

}  // namespace welkin
