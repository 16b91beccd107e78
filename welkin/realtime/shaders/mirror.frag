// Miller & Hoffman 1984: the radiance of the mirrored direction, times Schlick's Fresnel term.
#include "surface.glsl"
#include "environment.glsl"

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  float fresnel = pow(1.0 - cos_view, 5.0);
  return mix(s.f0, s.f90, fresnel) * environment_radiance(reflect(-s.view, s.normal));
}

#include "forward.glsl"
