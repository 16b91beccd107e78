#pragma once
#include <array>
#include <cstddef>
#include <span>

#include <welkin/sphere/vec3.h>

// Real spherical harmonics Y_lm: orthonormal over the sphere, no Condon-Shortley sign, degree l, order m, polar axis
// z of the world frame, stored at index l (l + 1) + m. So Y_1-1 = 0.488603 y, Y_10 = 0.488603 z, Y_11 = 0.488603 x.

namespace welkin {

/// The place of Y_lm in an array of coefficients; -l <= m <= l.
constexpr std::size_t sh_index(int l, int m) { return static_cast<std::size_t>(l * (l + 1) + m); }

/// How many functions there are up to and including max_degree.
constexpr std::size_t sh_count(int max_degree) {
  return static_cast<std::size_t>(max_degree + 1) * static_cast<std::size_t>(max_degree + 1);
}

/// The largest degree that evaluate_sh_basis takes. Beyond it sin^m theta underflows where the functions matter.
inline constexpr int max_basis_degree = 1800;

/// Writes Y_lm(direction) for every l <= max_degree to out[sh_index(l, m)]; direction is unit length and
/// out.size() >= sh_count(max_degree), 0 <= max_degree <= max_basis_degree.
/// By the three-term recurrence in l of the fully normalised Legendre functions, which is stable (Holmes &
/// Featherstone 2002, section 2.1): error about 1e-13 at degree 1000.
void evaluate_sh_basis(Vec3 direction, int max_degree, std::span<double> out);

/// The 25 functions to degree 4 written out as polynomials in x, y, z (Kautz 2006 lists them): the same values and
/// order as evaluate_sh_basis(direction, 4, out), faster, and the form that shaders use.
std::array<double, 25> sh_basis_degree4(Vec3 direction);

}  // namespace welkin
