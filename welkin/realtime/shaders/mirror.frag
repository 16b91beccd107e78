// Miller & Hoffman 1984: the radiance of the mirrored direction, times Schlick's Fresnel term. Far away or strongly curved, a
// pixel sees many texels: the derivatives of the mirrored view choose the level of box mips that is as coarse.
#include "surface.glsl"
#include "environment.glsl"

uniform bool mirror_footprint;   // else a point

vec3 mirrored_radiance(vec3 direction) {
  if (!mirror_footprint) return environment_radiance(direction);
  vec3 d = in_map(direction);
  return textureGrad(environment_map, d, dFdx(d), dFdy(d)).rgb;
}

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  float fresnel = pow(1.0 - cos_view, 5.0);
  return mix(s.f0, s.f90, fresnel) * mirrored_radiance(reflect(-s.view, s.normal));
}

#include "forward.glsl"
