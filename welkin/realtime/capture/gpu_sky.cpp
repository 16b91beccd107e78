#include <welkin/realtime/capture/gpu_sky.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/envmap/sky/sky_coefficients.h>

namespace welkin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double largest_half = 65504, least_radius = 0.265 * pi / 180;

Vec3f to_vec3f(const std::array<double, 3>& c, double scale = 1) {
  return {static_cast<float>(scale * c[0]), static_cast<float>(scale * c[1]),
          static_cast<float>(scale * c[2])};
}

Vec3f to_vec3f(Vec3 d) { return to_vec3f(std::array<double, 3>{d.x, d.y, d.z}); }

// The integral over the sphere of the disc with its ramp of half a radius, clamp((radius - angle) / (radius / 2) + 1/2): Simpson's rule over
// the ramp, the flat part in closed form.
double disc_solid_angle(double radius) {
  const double inner = 0.75 * radius, outer = 1.25 * radius;
  constexpr int intervals = 32;
  double ramp = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double share = static_cast<double>(i) / intervals;
    const double weight = i == 0 || i == intervals ? 1 : (i % 2 == 1 ? 4 : 2);
    ramp += weight * (1 - share) * std::sin(inner + share * (outer - inner));
  }
  ramp *= (outer - inner) / (3 * intervals);
  return 2 * pi * (1 - std::cos(inner) + ramp);
}

}  // namespace

// The sun runs on a circle that is tilted by 30 degrees from the zenith.
SunPlace sun_at(double time_seconds) {
  const double turn = pi * time_seconds / 60;
  const double x = std::cos(turn), y = std::sin(turn) * std::sqrt(0.75), z = std::sin(turn) * 0.5;
  return {std::asin(std::clamp(y, -1.0, 1.0)) * 180 / pi, std::atan2(z, x) * 180 / pi};
}

GpuSky make_gpu_sky(SunPlace sun, const GpuSkyOptions& options) {
  const SkyCoefficients sky =
      make_sky_coefficients(sun.elevation, sun.azimuth, options.turbidity, options.albedo);
  GpuSky gpu;
  for (std::size_t i = 0; i < 5; ++i) gpu.perez[i] = to_vec3f(sky.perez[i]);
  gpu.zenith = to_vec3f(sky.zenith);
  gpu.zenith.x *= static_cast<float>(options.scale);
  gpu.distribution_sun = to_vec3f(sky.distribution_sun);
  gpu.disc_sun = to_vec3f(sky.sun);
  gpu.ground = to_vec3f(sky.ground, options.scale);
  const double radius = std::max(options.disc_radius, least_radius);
  std::array<double, 3> disc{};
  for (std::size_t c = 0; c < 3 && options.sun; ++c)
    disc[c] = std::min(options.scale * sky.sun_irradiance[c] / disc_solid_angle(radius), largest_half);
  gpu.disc_radiance = to_vec3f(disc);
  gpu.disc_radius = static_cast<float>(radius);
  gpu.disc_edge = static_cast<float>(radius / 2);
  return gpu;
}

void set_sky(const Program& program, const GpuSky& sky) {
  program.set_vec3_array("sky_perez", {sky.perez.begin(), sky.perez.end()});
  program.set("sky_zenith", sky.zenith);
  program.set("sky_distribution_sun", sky.distribution_sun);
  program.set("sky_disc_sun", sky.disc_sun);
  program.set("sky_ground", sky.ground);
  program.set("sky_disc_radiance", sky.disc_radiance);
  program.set("sky_disc_radius", sky.disc_radius);
  program.set("sky_disc_edge", sky.disc_edge);
}

}  // namespace welkin
