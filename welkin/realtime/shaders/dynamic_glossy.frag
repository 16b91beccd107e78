// Glossy by the maps that were filtered in this frame and the DFG table, diffuse by its irradiance map.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "glossy.glsl"
uniform samplerCube lobe_map;  // E

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  vec2 dfg = look_up_dfg(cos_view, s.perceptual_roughness);
  vec3 glossy = reflected_share(dfg, s.f0, s.f90, material_compensated) *
                glossy_radiance(reflect(-s.view, s.normal), s.perceptual_roughness);
  return glossy + coat_transmission(s, dfg) * s.diffuse / PI * max(textureLod(lobe_map, s.normal, 0.0).rgb, 0.0);
}

#include "forward.glsl"
