#pragma once
#include <array>

#include <welkin/sphere/vec3.h>

namespace welkin {

/// A clear sky over a lit ground, as numbers for a shader that evaluates Preetham's distribution itself:
/// (Y, x, y) = zenith (1 + a e^(b / cos_zenith)) (1 + c e^(d gamma) + e cos^2 gamma), gamma the angle to distribution_sun.
struct SkyCoefficients {
  std::array<std::array<double, 3>, 5> perez{};  ///< a to e, each for Y, x, y
  std::array<double, 3> zenith{};                ///< Y (W/(sr m^2)), x, y, over the distribution there
  Vec3 distribution_sun;                         ///< unit; on the horizon after sunset
  Vec3 sun;                                      ///< unit
  std::array<double, 3> sun_irradiance{};        ///< of a surface that faces the sun, W/m^2, linear Rec.709
  std::array<double, 3> ground{};                ///< radiance of the ground, lit by sky and sun
};

/// Angles in degrees, as DaylightOptions has them; albedo of the ground.
SkyCoefficients make_sky_coefficients(double elevation, double azimuth, double turbidity, double albedo);

}  // namespace welkin
