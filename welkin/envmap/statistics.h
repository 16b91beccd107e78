#pragma once
#include <array>

#include <welkin/image/image.h>
#include <welkin/sphere/vec3.h>

namespace welkin {

/// What an equirectangular radiance map amounts to. Colours are linear Rec. 709 in the map's units.
struct MapStatistics {
  std::array<double, 3> mean_radiance{};  ///< over the sphere, by solid angle
  std::array<double, 3>
      energy{};  ///< integral over the sphere: 4 pi times the mean (W/m^2 for radiance in W/(sr m^2))
  std::array<double, 3> irradiance_up{};      ///< on a plane that faces +Y
  std::array<double, 3> irradiance_down{};    ///< on a plane that faces -Y
  double min_radiance = 0, max_radiance = 0;  ///< of any channel
  int brightest_x = 0, brightest_y = 0;       ///< the texel with the largest luminance
  Vec3 brightest_direction;
  double brightest_luminance = 0;
  double brightest_share = 0;  ///< of the map's luminous energy that comes from that one texel
};

/// radiance has 3 channels and finite values; any proportions. Same bits on any number of threads.
MapStatistics map_statistics(const Image& radiance);

}  // namespace welkin
