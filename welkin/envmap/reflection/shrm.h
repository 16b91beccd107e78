#pragma once
#include <array>
#include <optional>
#include <string>

#include <welkin/brdf/isotropic.h>
#include <welkin/envmap/reflection/brdf_spectrum.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>
#include <welkin/sh/spin_synthesis.h>

// Spherical-harmonic reflection maps (Ramamoorthi & Hanrahan 2002, "Frequency space environment map rendering"): at
// each point of a sphere, the coefficients of a small spherical-harmonic expansion over the view. One map answers
// every normal and every view for one isotropic BRDF.

namespace welkin {

struct ShrmOptions {
  /// The relative RMS error asked for, over all normals and views: sqrt(mean of squared error / mean of squared
  /// value).
  double error_bound = 0.02;
  /// Limits of the orders that may be chosen: degrees of the light (F), 0 .. 128, and order of the view (P), 0 .. 16.
  int max_degree = 64, max_order = 12;
  /// Fixes the choice instead of making it from the bound.
  std::optional<ReflectionFrame> frame;
  std::optional<int> degree, order;
  /// Views count in the error from this cosine on, uniform in the cosine.
  double smallest_cos_view = 0.05;
};

struct ShrmReport {
  ReflectionFrame frame = ReflectionFrame::reflected;
  int degree = 0;  ///< F: degrees of the light
  int order = 0;   ///< P: order of the view
  int maps = 0;    ///< real coefficient maps
  int rows = 0, columns = 0;
  /// Relative RMS; the mean over all orientations is exact but for quadrature and grid.
  double predicted_error = 0;
  bool bound_met = false;   ///< false where no allowed choice keeps the bound; then the best one was taken
  double brdf_seconds = 0;  ///< expansion of the BRDF and choice of the orders: once a material
  double analysis_seconds = 0;   ///< spectrum of the map: once a map
  double synthesis_seconds = 0;  ///< the coefficient maps
};

/// Reflected radiance of one BRDF under one environment. 4 maps * rows * columns * 3 bytes.
struct ReflectionMap {
  std::string brdf;
  SpinGrid coefficients;
  ShrmReport report;
};

/// Prefilters an equirectangular radiance map of 3 channels. Throws Error when an option is out of its range, the
/// map has not 3 channels, or the BRDF is too narrow (see make_brdf_spectrum).
ReflectionMap prepare_shrm(const Image& radiance, const IsotropicBrdf& brdf, const ShrmOptions& options = {});

/// Reflected radiance; 0 where the view lies below the surface. The expansion may ring below 0 by about its error;
/// it is not clamped.
std::array<double, 3> reflect(const ReflectionMap& map, const ReflectionQuery& query);

}  // namespace welkin
