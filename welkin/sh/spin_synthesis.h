#pragma once
#include <span>
#include <vector>

#include <welkin/sh/spectrum.h>
#include <welkin/sphere/mat3.h>
#include <welkin/sphere/vec3.h>

// What a function on the sphere looks like from every direction: its coefficients in the local frame of each point,
// each degree weighted, as maps over the sphere. With q = 0 it is convolution; with q > 0 the maps are spin-weighted
// functions (Goldberg et al. 1967), whose value depends on the choice of the tangent frame.

namespace welkin {

/// The largest degree of spin synthesis: below it its starting values underflow only where they do not matter.
inline constexpr int max_spin_degree = 128;

/// The frame at a point: rows are e_theta (downwards), e_phi (rightwards in the equirectangular map) and the
/// direction itself. Left-handed as coordinates of the world, as the equirectangular azimuth is; orthonormal. A
/// function f has there the local spectrum c_lq with
///   f(omega) = sum over l of [ c_l0 P_l0 + 2 Re sum_(q>0) c_lq P_lq(cos theta') exp(i q phi') ],
/// theta', phi' being the polar angle and azimuth of (rows . omega).
Mat3 spin_frame(Vec3 direction);

/// One map: sum over l of factors[l * channels + c] c_lq, q = spin >= 0.
struct SpinFilter {
  int spin = 0;
  std::vector<double> factors;  ///< (max_degree + 1) * channels of the spectrum
};

/// Maps on the grid of SphereGrid (transform.h) without its margins: the sample (row r, column c) lies at
/// theta = pi (r + 1/2)/rows, phi = 2 pi (c + 1/2)/columns - pi. A filter of spin 0 has one real slot, the others
/// have two, real and imaginary part; slots in the order of the filters, channels innermost.
struct SpinGrid {
  int rows = 0, columns = 0, channels = 0;
  std::vector<int> slot_spin;  ///< the spin that each slot belongs to
  std::vector<float> values;   ///< (row * columns + column) * slots * channels + slot * channels + channel

  int stride() const { return static_cast<int>(slot_spin.size()) * channels; }
};

/// All filters at once, O(rows max_degree^2) a filter; filters of equal spin stand together. The spectrum has at most
/// max_spin_degree; rows >= 8 and columns > 2 max_degree are even. Same bits on any number of threads.
SpinGrid synthesize_spin(const Spectrum& spectrum, std::span<const SpinFilter> filters, int rows,
                         int columns);

/// The slots in a unit direction, in the frame spin_frame(direction), by 8 x 8 point Lagrange interpolation; out has
/// stride() elements. Exact across the poles too: there the maps go on with the sign (-1)^q. For a component of
/// degree l the error is about 2e-3 (pi l / rows)^8 of its amplitude.
void interpolate(const SpinGrid& grid, Vec3 direction, std::span<float> out);

}  // namespace welkin
