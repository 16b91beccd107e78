// Irradiance from nine coefficients of the radiance, pixel by pixel (Ramamoorthi & Hanrahan 2001, equation 10).
#include "surface.glsl"
#include "environment.glsl"

vec3 irradiance_sh(vec3 n) {  // n in the frame of the map
  vec3 e = COSINE_0 * SH_0 * radiance_sh[0] +
           COSINE_1 * SH_1 * (radiance_sh[1] * n.y + radiance_sh[2] * n.z + radiance_sh[3] * n.x) +
           COSINE_2 * (SH_2 * (radiance_sh[4] * n.x * n.y + radiance_sh[5] * n.y * n.z + radiance_sh[7] * n.x * n.z) +
                       SH_20 * radiance_sh[6] * (3.0 * n.z * n.z - 1.0) + SH_22 * radiance_sh[8] * (n.x * n.x - n.y * n.y));
  return max(e, vec3(0.0));  // opposite a sun nine coefficients can be negative
}

vec3 shade(Surface s) { return s.diffuse / PI * irradiance_sh(in_map(s.normal)); }

#include "forward.glsl"
