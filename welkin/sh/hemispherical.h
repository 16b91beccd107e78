#pragma once
#include <array>
#include <vector>

#include <welkin/sh/projection.h>
#include <welkin/sphere/mat3.h>

// The H-basis of Habel & Wimmer 2010, "Efficient Irradiance Normal Mapping": 4 or 6 orthonormal functions over the
// hemisphere about a normal, for light that a surface's normal map looks up. In the tangent frame (x tangent, y bitangent,
// z normal; no Condon-Shortley sign, as everywhere here):
//   H1 = 1/sqrt(2 pi)                H2 = sqrt(3/(2 pi)) y              H3 = sqrt(3/(2 pi)) (2 z - 1)
//   H4 = sqrt(3/(2 pi)) x            H5 = sqrt(15/(2 pi)) x y           H6 = sqrt(15/(8 pi)) (x^2 - y^2)
// H1, H3 are the first two Legendre polynomials shifted to [0, 1]; the others are spherical harmonics with |m| = l,
// which are even in z, times sqrt 2.
// Irradiance from one light, RMS error over the hemisphere relative to its RMS, worst light down to the horizon: 31 % with
// 4 functions, 14 % with 6, 8.8 % with the nine coefficients of degree 2 that they are fitted to (tested).

namespace welkin {

/// All six functions in a unit direction of the tangent frame, z >= 0.
std::array<double, 6> h_basis(Vec3 tangent_direction);

/// A right-handed frame with this unit normal as its last row; rows: tangent, bitangent, normal.
Mat3 tangent_frame(Vec3 normal);

/// A function over the hemisphere about frame.rows[2].
struct HemisphericalCoefficients {
  int functions = 4;  ///< 4 or 6
  int channels = 3;
  Mat3 frame;                  ///< rows: tangent, bitangent, normal in the world
  std::vector<double> values;  ///< channels interleaved: values[function * channels + c]
};

/// The matrix from spherical-harmonic coefficients in the tangent frame to the H-basis, functions x sh_count(max_degree)
/// row-major: the integrals of H_i Y_lm over the hemisphere, exact to rounding. functions is 4 or 6 and max_degree in
/// [0, 64], else Error.
std::vector<double> hemispherical_matrix(int functions, int max_degree);

/// The least-squares fit over the hemisphere of the function (usually irradiance): rotate to the frame, multiply by the
/// matrix. The frame is a rotation (else Error), or made by tangent_frame from a unit normal.
HemisphericalCoefficients project_hemispherical(const ShCoefficients& function, const Mat3& frame,
                                                int functions);
HemisphericalCoefficients project_hemispherical(const ShCoefficients& function, Vec3 normal, int functions);

/// The value in a unit direction of the world on the normal's side, one per channel, to out.
void evaluate(const HemisphericalCoefficients& coefficients, Vec3 direction, std::span<double> out);

}  // namespace welkin
