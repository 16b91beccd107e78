#pragma once
#include <array>
#include <vector>

#include <welkin/sphere/vec3.h>

// The sky of welkin/envmap/sky in a header of its own: its colours and the renderer's have the same name.

namespace welkin {

/// Radiances of PreethamSky in some directions, the sun's disc left out; turbidity 3.
std::vector<std::array<double, 3>> preetham_radiances(double elevation, double azimuth,
                                                      const std::vector<Vec3>& directions);

/// The sun's irradiance on a surface that faces it.
std::array<double, 3> preetham_sun_irradiance(double elevation, double azimuth);

}  // namespace welkin
