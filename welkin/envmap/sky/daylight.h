#pragma once
#include <welkin/envmap/sky/rgb.h>
#include <welkin/sphere/vec3.h>

// Clear daylight, as functions of direction: the sky of Preetham, Shirley and Smits 1999 and the sun behind the same
// atmosphere. Radiances are linear Rec.709 in W/(sr m^2) under Ward's 1994 convention that white light carries
// 179 lm/W: luminance in cd/m^2 = 179 (0.2126 R + 0.7152 G + 0.0722 B).

namespace welkin {

/// Lumens in a watt of the radiances here (Ward 1994).
inline constexpr double luminous_efficacy = 179;

/// The sun's angular diameter as seen from the earth, in degrees.
inline constexpr double sun_diameter_degrees = 0.53;

struct DaylightOptions {
  /// Of the sun's centre above the horizon, degrees, -90 to 90.
  double elevation = 35;
  /// Degrees from +X (the middle column of an equirectangular map) towards +Z (rightwards).
  double azimuth = 30;
  /// 1.7 (very clear) to 10 (hazy).
  double turbidity = 3;
  /// Brightness of the sky by the published zenith luminance in place of the balance with the sun
  /// (sky_illuminance): 1.5 to 2.1 times that with a high sun, 12 to 31 times at sunset.
  bool published_zenith = false;
};

/// Direction of the sun's centre.
Vec3 sun_direction(const DaylightOptions& options);

/// What the sun's direct light brings to a surface that faces it, W/m^2 in linear Rec.709, at the ground. The
/// extraterrestrial spectrum (Thekaekara 1973) through Rayleigh scattering, Angstrom's aerosol, ozone and water vapour
/// (Preetham et al. 1999, appendix A.1, after Iqbal 1983), integrated against the colour matching functions (Wyman et
/// al. 2013). Below the horizon the air mass stays at its value there.
Rgb sun_irradiance(const DaylightOptions& options);

/// Radiance of the sun's disc, uniform: sun_irradiance over the disc's solid angle.
Rgb sun_radiance(const DaylightOptions& options);

/// Illuminance of the sky without the sun on a horizontal surface, as luminance / 179 in W/m^2: what the molecules and
/// the aerosol scatter out of the sunlight and send down (Bird & Riordan 1986, without light from the ground), with the
/// spectrum and the atmosphere of sun_irradiance.
double sky_illuminance(const DaylightOptions& options);

/// Solid angle of the sun's disc, sr.
double sun_solid_angle();

/// The sky without the sun. Evaluated in two steps because a map needs the part that depends on height alone once a row.
class PreethamSky {
 public:
  explicit PreethamSky(const DaylightOptions& options);

  /// Radiance towards the unit direction `direction` with y >= 0 (y < 0 counts as the horizon).
  Rgb radiance(Vec3 direction) const;

  /// The factor of the three distributions (Y, x, y) that depends on cos_zenith = direction.y alone.
  Rgb gradation(double cos_zenith) const;
  /// radiance(direction), given gradation(direction.y).
  Rgb radiance(Vec3 direction, Rgb gradation_of_y) const;

  /// Irradiance of a horizontal surface under this sky (no sun), W/m^2.
  Rgb horizontal_irradiance() const;

  /// What a shader needs: (Y, x, y) = zenith (1 + a e^(b / cos_zenith)) (1 + c e^(d gamma) + e cos^2 gamma), each with its own
  /// coefficients, gamma the angle to sun() (which stays on the horizon after sunset).
  struct Perez {
    double a, b, c, d, e;
  };
  const std::array<Perez, 3>& perez() const { return perez_; }
  const Rgb& zenith() const { return zenith_; }
  Vec3 sun() const { return sun_; }

 private:
  std::array<Perez, 3> perez_;  // for Y, x, y
  Rgb zenith_;                  // Y (W/(sr m^2)), x, y over the distribution's own value at the zenith
  Vec3 sun_;
};

}  // namespace welkin
