#pragma once
#include <array>

#include <welkin/realtime/gl/program.h>

namespace welkin {

/// Where the sun of the animations stands, in degrees as DaylightOptions has them.
struct SunPlace {
  double elevation = 0, azimuth = 0;
};

/// A day of 60 s from sunrise (0 s, in +X) over 60 degrees in the south (+Z, at 30 s) to sunset, and a night of as long.
SunPlace sun_at(double time_seconds);

/// A clear sky for shaders: the uniforms of daylight.glsl.
struct GpuSky {
  std::array<Vec3f, 5> perez;
  Vec3f zenith, distribution_sun, disc_sun;
  Vec3f ground, disc_radiance;
  float disc_radius = 0, disc_edge = 0;  ///< radians
};

struct GpuSkyOptions {
  double turbidity = 3, albedo = 0.2;  ///< of the ground
  double scale = 1;                    ///< on W/(sr m^2)
  /// The sun is drawn as a disc of this radius (radians; at least its own, 0.265 degrees) with its irradiance kept, and a soft edge; a capture
  /// of N texels an edge shows it rightly from 4 / N on. Radiance above the largest half float is cut.
  double disc_radius = 0.08;
  bool sun = true;  ///< else the disc is left out, and the ground stays lit by it
};

GpuSky make_gpu_sky(SunPlace sun, const GpuSkyOptions& options = {});

/// The program is in use.
void set_sky(const Program& program, const GpuSky& sky);

}  // namespace welkin
