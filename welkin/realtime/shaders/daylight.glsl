// Preetham's sky (Preetham, Shirley & Smits 1999) as welkin/envmap/sky/daylight.h has it, a ground and a sun of any width; the
// coefficients come from there, so that only the distribution itself is written twice (a test compares).
uniform vec3 sky_perez[5];      // a to e, each for Y, x and y
uniform vec3 sky_zenith;        // Y, x, y over the distribution's value there
uniform vec3 sky_distribution_sun, sky_disc_sun;  // unit; the first stays on the horizon after sunset
uniform vec3 sky_ground, sky_disc_radiance;
uniform float sky_disc_radius, sky_disc_edge;     // radians; the edge is a ramp of this width

float angle_between(vec3 a, vec3 b) { return 2.0 * asin(clamp(0.5 * length(a - b), 0.0, 1.0)); }  // exact at small angles

vec3 daylight_without_sun(vec3 direction) {
  if (direction.y <= 0.0) return sky_ground;
  float gamma = angle_between(direction, sky_distribution_sun), cosine = cos(gamma);
  vec3 value = sky_zenith * (1.0 + sky_perez[0] * exp(sky_perez[1] / direction.y)) *
               (1.0 + sky_perez[2] * exp(sky_perez[3] * gamma) + sky_perez[4] * cosine * cosine);
  value.x = max(value.x, 0.0);
  vec3 xyz = value.x * vec3(value.y / value.z, 1.0, (1.0 - value.y - value.z) / value.z);
  return max(vec3(dot(vec3(3.2406, -1.5372, -0.4986), xyz), dot(vec3(-0.9689, 1.8758, 0.0415), xyz),
                  dot(vec3(0.0557, -0.2040, 1.0570), xyz)), 0.0);
}

vec3 daylight(vec3 direction) {
  float inside = (sky_disc_radius - angle_between(direction, sky_disc_sun)) / sky_disc_edge + 0.5;
  return daylight_without_sun(direction) + (direction.y > 0.0 ? clamp(inside, 0.0, 1.0) : 0.0) * sky_disc_radiance;
}
