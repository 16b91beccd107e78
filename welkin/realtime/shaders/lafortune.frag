// Lafortune's lobes (McAllister, Lastra & Heidrich 2002): cos^N about (Cx vx, Cy vy, Cz vz) in the frame of the surface.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "power_lobe.glsl"

vec3 shade(Surface s) {
  if (material_power == POWER_NONE) return power_shade_other(s);
  vec3 weights = material_power == POWER_LAFORTUNE ? material_lafortune : vec3(-1.0, -1.0, 1.0);
  vec3 local = weights * vec3(dot(s.view, s.tangent), dot(s.view, s.bitangent), dot(s.view, s.normal));
  return power_material(s, local.x * s.tangent + local.y * s.bitangent + local.z * s.normal);
}

#include "forward.glsl"
