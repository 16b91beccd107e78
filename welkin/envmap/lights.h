#pragma once
#include <array>
#include <vector>

#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

// The sun as a light. An environment's strong compact sources are what a few coefficients, a coarse level or a sampler
// cannot hold, and what an engine can draw exactly: a directional light with a shadow. Here they are taken out.

namespace welkin {

/// A source far away. A surface whose unit normal n sees all of it gets irradiance max(0, dot(n, direction)) times
/// `irradiance`.
struct DirectionalLight {
  Vec3 direction;                      ///< towards the light, unit length
  std::array<double, 3> irradiance{};  ///< of a surface that faces it, W/m^2, linear Rec. 709
  double angular_radius = 0;           ///< rad, of the uniform disc of the same spread
  std::array<double, 3> color{};       ///< irradiance / illuminance: its luminance is 1
  double illuminance = 0;  ///< luminance of the irradiance, W/m^2; times 179 in lux for daylight maps
  double share = 0;        ///< of the map's luminous flux from all directions
};

/// What a surface with the unit normal gets from the light, as a uniform disc of its angular radius, in closed form
/// (the part above the horizon by Lambert's contour integral; derivation in lights.cpp).
std::array<double, 3> disc_irradiance(const DirectionalLight& light, Vec3 normal);

/// The same as a direction without extent, as engines draw it: irradiance * max(0, cos).
std::array<double, 3> directional_irradiance(const DirectionalLight& light, Vec3 normal);

struct LightOptions {
  int max_lights = 1;             ///< at least 1
  double max_angular_radius = 3;  ///< degrees, 0.05 to 45: sources that are larger stay in the map
  double min_share = 0.01;        ///< of the map's luminous flux, 0 to 1: weaker sources stay in the map
};

/// map = residual + lights.
struct ExtractedLights {
  std::vector<DirectionalLight> lights;  ///< strongest first; none where nothing is strong and compact
  Image residual;                        ///< the map without them, filled from around; nowhere above the map
};

/// Takes the strongest compact sources out of an equirectangular map of 3 channels, finite and >= 0. Throws Error for
/// options out of range and for maps of 2^31 texels and more.
///
/// A source is a connected region brighter than all around it (light_regions.h), or several that lie close together
/// (a sun behind a branch, the panes of a window), as long as the whole is no larger than max_angular_radius. When the
/// map has no more of them, what is left is searched again: with two lights of up to 10 degrees, the second may be the
/// glow about the sun. What is taken is the map minus its fill (inpaint.h), so that residual and taken light add up to
/// the map exactly. With V_c the vector irradiance of channel c, the integral of taken radiance times direction,
/// `direction` is that of the luminance of V, and irradiance[c] = dot(V_c, direction): exact for every normal that sees
/// the whole source.
ExtractedLights extract_lights(const Image& equirect, const LightOptions& options = {});

}  // namespace welkin
