// Irradiance map for the diffuse part, GGX-filtered chain and DFG table for the glossy one (Karis 2013).
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  vec2 dfg = look_up_dfg(cos_view, s.perceptual_roughness);
  vec3 glossy = reflected_share(dfg, s.f0, s.f90, material_compensated) *
                prefiltered_ggx(reflect(-s.view, s.normal), s.perceptual_roughness);
  return glossy + coat_transmission(s, dfg) * s.diffuse / PI * irradiance(s.normal);
}

#include "forward.glsl"
