#include "preetham_reference.h"

#include <welkin/envmap/sky/daylight.h>

namespace welkin {

std::vector<std::array<double, 3>> preetham_radiances(double elevation, double azimuth,
                                                      const std::vector<Vec3>& directions) {
  const PreethamSky sky({elevation, azimuth, 3});
  std::vector<std::array<double, 3>> radiances;
  for (const Vec3 direction : directions) radiances.push_back(sky.radiance(direction));
  return radiances;
}

std::array<double, 3> preetham_sun_irradiance(double elevation, double azimuth) {
  return sun_irradiance({elevation, azimuth, 3});
}

}  // namespace welkin
