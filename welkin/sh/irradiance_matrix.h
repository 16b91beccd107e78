#pragma once
#include <array>
#include <span>

#include <welkin/sh/projection.h>

// Irradiance of degree 2 as one symmetric 4 x 4 matrix a channel: E(n) = (x, y, z, 1) M (x, y, z, 1)^T (Ramamoorthi &
// Hanrahan 2001, equations 11 and 12). Three matrices hold the same 27 numbers as nine RGB coefficients; shaders like
// them because E is two products.

namespace welkin {

using QuadraticForm = std::array<std::array<double, 4>, 4>;  // rows; symmetric here

/// Red, green, blue.
using IrradianceMatrices = std::array<QuadraticForm, 3>;

/// The matrices of nine irradiance coefficients (the cosine is in them; E, not E / pi: for E / pi pass coefficients of
/// E / pi). On |n| = 1 a multiple of diag(1, 1, 1, -1) changes nothing; the form is fixed as in equation 12: the first
/// two diagonal entries are opposite, z^2 carries all of Y_20's square and the last entry its constant, c4 E_00 - c5
/// E_20. Needs degree 2 and three channels; throws Error otherwise.
IrradianceMatrices irradiance_matrices(const ShCoefficients& irradiance);

/// The same from nine radiance coefficients: multiplies degree l by A_l = pi, 2 pi/3, pi/4 first, as equation 12 does
/// with c1 = 0.429043, c2 = 0.511664, c3 = 0.743125, c4 = 0.886227, c5 = 0.247708.
IrradianceMatrices irradiance_matrices_from_radiance(const ShCoefficients& radiance);

/// Back to nine irradiance coefficients, to rounding. Takes any symmetric matrices, of this form or with another split
/// between trace and constant.
ShCoefficients irradiance_from_matrices(const IrradianceMatrices& matrices);

/// E(n) of one channel; n is unit length.
double evaluate(const QuadraticForm& matrix, Vec3 normal);

/// Irradiance per vertex: rgb[i] = E(normals[i]) for unit normals; both spans have one size. Single precision: off by
/// about 3e-7 of the largest entry. Vectorised; the second is the plain loop that it is tested against.
void irradiance_of_normals(const IrradianceMatrices& matrices, std::span<const std::array<float, 3>> normals,
                           std::span<std::array<float, 3>> rgb);
void irradiance_of_normals_scalar(const IrradianceMatrices& matrices,
                                  std::span<const std::array<float, 3>> normals,
                                  std::span<std::array<float, 3>> rgb);

}  // namespace welkin
