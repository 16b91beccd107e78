#include <welkin/envmap/sky/sky_coefficients.h>

#include <algorithm>
#include <numbers>

#include <welkin/envmap/sky/daylight.h>

namespace welkin {

SkyCoefficients make_sky_coefficients(double elevation, double azimuth, double turbidity, double albedo) {
  const DaylightOptions options{elevation, azimuth, turbidity};
  const PreethamSky sky(options);
  using Perez = PreethamSky::Perez;
  constexpr double Perez::*members[5] = {&Perez::a, &Perez::b, &Perez::c, &Perez::d, &Perez::e};
  SkyCoefficients result;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t c = 0; c < 3; ++c) result.perez[i][c] = sky.perez()[c].*members[i];
  result.zenith = sky.zenith();
  result.distribution_sun = sky.sun();
  result.sun = sun_direction(options);
  result.sun_irradiance = sun_irradiance(options);
  const double shares = std::max(0.0, result.sun.y);
  result.ground =
      (albedo / std::numbers::pi) * (sky.horizontal_irradiance() + shares * result.sun_irradiance);
  return result;
}

}  // namespace welkin
