#pragma once
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sh/spectrum.h>
#include <welkin/sphere/vec3.h>

// The fast spherical-harmonic transform: FFT along the rows, Legendre sums along the columns, O(rows degree^2) in all
// (see transform_legendre.h for the kernel and its derivation). Same bits on any number of threads.

namespace welkin {

struct AnalysisOptions {
  /// The largest degree wanted, >= 0. May exceed what the map resolves: a map of patches has content at all degrees.
  int max_degree = 255;
  /// How exactly the rows are integrated: the relative quadrature error allowed at max_degree; it falls with a high
  /// power of the degree below that.
  double accuracy = 1e-5;
};

/// The spectrum of an equirectangular map: a_lm = integral of f conj(Y_lm). Each texel is a patch on which f is
/// constant, integrated in azimuth exactly and in theta by Gauss-Legendre nodes chosen from options.accuracy.
/// equirect has 1, 3 or 4 channels and at least one pixel; any width and height.
Spectrum analyze(const Image& equirect, const AnalysisOptions& options = {});

/// Values of a band-limited function on an equirectangular grid, with margins so that a stencil never wraps: the
/// sample (row r, column c) lies at theta = pi (r + 1/2)/rows, phi = 2 pi (c + 1/2)/columns - pi.
struct SphereGrid {
  static constexpr int margin = 4;
  int rows = 0, columns = 0, channels = 3;
  std::vector<float> values;  // (rows + 2 margin) x (columns + 2 margin) x channels

  float* at(int row, int column) {
    return values.data() +
           (static_cast<std::size_t>(row + margin) * (columns + 2 * margin) + (column + margin)) * channels;
  }
  const float* at(int row, int column) const { return const_cast<SphereGrid*>(this)->at(row, column); }
};

/// Evaluates a spectrum on a grid of `rows` (even, >= 2) x `columns` (even, > 2 max_degree).
SphereGrid synthesize(const Spectrum& spectrum, int rows, int columns);

/// The value in a unit direction by 8 x 8 point Lagrange interpolation, to out (one per channel). For a component of
/// degree l the error is at most about 2e-3 (pi l / rows)^8 of its amplitude, so 1e-6 at l = rows/8.
void interpolate(const SphereGrid& grid, Vec3 direction, float* out);

}  // namespace welkin
