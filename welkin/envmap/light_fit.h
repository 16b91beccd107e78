#pragma once
#include <vector>

#include <welkin/envmap/lights.h>
#include <welkin/sh/projection.h>

// The best few lights beside nine coefficients. What nine coefficients cannot hold of an environment's irradiance is
// its degrees 4, 6, 8, ... A directional light has them in the right proportion, whether or not the map has a compact
// source. So lights are chosen for the irradiance alone: stronger than a sun by its glow, and two of them for a bright
// part of the sky.

namespace welkin {

/// radiance's irradiance = lights + that of nine coefficients.
struct LightFit {
  std::vector<DirectionalLight> lights;  ///< without extent; share is that of the map's flux
  ShCoefficients rest;                   ///< radiance coefficients of degree 2 of the map less the lights
  /// RMS over the sphere of what nine coefficients miss of the irradiance's luminance, W/m^2.
  double error_before = 0;
  double error = 0;  ///< the same with the lights
};

/// At most `max_lights` (1 to 8) directional lights and nine coefficients. The directions are those that leave the least
/// squares of the irradiance's error in luminance over all normals: each new light is the best one, then all are moved
/// together (to a local optimum). Each channel then has its own least-squares irradiance >= 0, which in strongly
/// coloured maps is not the best for luminance. No lights where nine coefficients miss nothing. No physical source:
/// `rest` may be negative where a light is taken from what is spread wide. equirect has 3 channels, finite and >= 0.
/// Throws Error for options out of range.
LightFit fit_lights(const Image& equirect, int max_lights = 1);

}  // namespace welkin
