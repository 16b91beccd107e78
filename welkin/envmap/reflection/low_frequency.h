#pragma once
#include <array>
#include <string>
#include <vector>

#include <welkin/brdf/isotropic.h>
#include <welkin/envmap/reflection/truth.h>
#include <welkin/image/image.h>
#include <welkin/sh/projection.h>

// Any isotropic BRDF under light of low frequency (Kautz, Sloan & Snyder 2002, "Fast, arbitrary BRDF shading for
// low-frequency lighting using spherical harmonics"): 25 numbers of light, turned into the frame of the surface,
// times 25 of the BRDF at the view's elevation.

namespace welkin {

struct LowFrequencyOptions {
  int max_degree = 4;  ///< of the light, 0 .. 10; 4 gives the 25 coefficients of the paper
  int views = 128;     ///< view elevations of the BRDF's table, >= 4
  /// Views count in the predicted error from this cosine on, uniform in the cosine.
  double smallest_cos_view = 0.05;
};

struct LowFrequencyReport {
  /// Relative RMS over all normals and views against the light as it is, not band-limited; what the table's
  /// interpolation adds is not in it.
  double predicted_error = 0;
  double light_seconds = 0;  ///< projection of the map: once a map
  double brdf_seconds = 0;   ///< table of the BRDF: once a material
  double error_seconds = 0;  ///< prediction of the error
};

struct LowFrequencyReflection {
  std::string brdf;
  ShCoefficients light;  ///< world frame, 3 channels
  int views = 0;
  /// [(view * (max_degree + 1)^2 + sh_index(l, q)) * 3 + channel]: coefficients of f cos+ over the light in the frame
  /// whose z is the normal and whose x is towards the view, at the elevations theta = (view + 1/2) pi / (2 views)
  /// from the normal. Those with q < 0 are 0: the BRDF is isotropic.
  std::vector<double> table;
  LowFrequencyReport report;
};

/// Throws Error when an option is out of its range, the map has not 3 channels, or the BRDF is too narrow.
LowFrequencyReflection prepare_low_frequency(const Image& radiance, const IsotropicBrdf& brdf,
                                             const LowFrequencyOptions& options = {});

/// Reflected radiance; 0 where the view lies below the surface. Band-limited light may ring below 0; not clamped.
std::array<double, 3> reflect(const LowFrequencyReflection& reflection, const ReflectionQuery& query);

}  // namespace welkin
