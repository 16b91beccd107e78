#pragma once
#include <array>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sh/spectrum.h>
#include <welkin/sphere/vec3.h>

// The fast spherical-harmonic transform: FFT along the rows, FFT along the columns to as few rows as the degree needs
// (colatitude_series.h), Legendre sums over those (transform_legendre.h), O(degree^3) in all besides the FFTs. Same bits
// on any number of threads; vector instructions are chosen when the program runs (welkin/parallel/simd.h).

namespace welkin {

struct AnalysisOptions {
  /// The largest degree wanted, >= 0. May exceed what the map resolves: a map of patches has content at all degrees.
  int max_degree = 255;

  /// Texels that count as if they had another value, so that nobody needs a copy of a large map to change a few.
  struct Replaced {
    int x = 0, y = 0;
    std::array<float, 4> value{};  ///< one a channel
  };
  std::vector<Replaced> replaced{};
};

/// The spectrum of an equirectangular map: a_lm = integral of f conj(Y_lm). Each texel is a patch on which f is
/// constant, integrated exactly in azimuth and in theta (colatitude_series.h): to about 1e-12 of the largest values.
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
