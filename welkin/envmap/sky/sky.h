#pragma once
#include <string>
#include <string_view>

#include <welkin/envmap/sky/rgb.h>
#include <welkin/image/image.h>

// Built-in environments: a day, a studio, and maps whose lighting has a closed form. All are functions of direction;
// a texel holds the mean over its solid angle. Radiance is linear Rec.709 in W/(sr m^2), where for day and overcast
// 179 lm are one watt (welkin/envmap/sky/daylight.h).

namespace welkin {

enum class SkyKind {
  day,       ///< Preetham's sky, an unclipped sun of 0.53 degrees, a Lambertian ground lit by both
  studio,    ///< soft boxes and a rim light in a dark room
  overcast,  ///< CIE standard overcast sky, grey, over a Lambertian ground
  constant,  ///< `value` everywhere
  texel,     ///< `value` in one texel, black elsewhere
  ramp,      ///< value (offset + slope y), y = cos of the zenith angle
  sh,        ///< value (offset + Y_lm)
  labelled,  ///< the labelled test map of welkin/sphere
};

struct SkyOptions {
  SkyKind kind = SkyKind::day;
  int width = 1024, height = 512;  // at least 1, at most 65536 and 2^30 texels

  // day, overcast
  double elevation = 35;  // of the sun, degrees, -90 to 90; overcast takes its brightness from it
  double azimuth = 30;    // of the sun, degrees from +X (the middle column) towards +Z (rightwards)
  double turbidity = 3;   // 1.7 to 10; day only
  double albedo = 0.2;    // of the ground, 0 to 1
  bool sun = true;        // false leaves the disc out of the map (the ground stays lit by it); day only

  // constant, texel, ramp, sh; at most 1e30 in size, times each other and scale too, so that irradiance fits float
  Rgb value{1, 1, 1};
  int x = -1, y = -1;  // texel; -1 is the middle
  double offset = 1;   // ramp, sh
  double slope = 0.5;  // ramp
  int degree = 2;      // sh, 0 to 100
  int order = 0;       // sh, -degree to degree

  double scale = 1;  // multiplies everything, of every kind; above 0, at most 1e30
};

/// Makes the map, 3 channels. Values may be negative for ramp and sh, if the options say so.
/// Throws Error naming the option that is out of its range.
Image make_sky(const SkyOptions& options = {});

/// Reads "sky:", "sky:KIND" or "sky:KIND,key=value,..." (the prefix "sky:" may be missing), for example
///   sky:day,elevation=35,azimuth=120,turbidity=3,size=1024x512
/// Keys are the members' names, `size` for width and height, `sun` 1 or 0, `value` a number or three of them joined by
/// colons (1:0.5:0.25). Throws Error that names a bad kind, key or number and lists what is valid.
SkyOptions parse_sky(std::string_view spec);

/// Whether `text` is meant for parse_sky: it starts with "sky:".
bool is_sky_spec(std::string_view text);

/// The kind of that name. Throws Error listing the names.
SkyKind parse_sky_kind(std::string_view name);

/// One line per kind and key, for a help text.
std::string sky_spec_help();

}  // namespace welkin
