// Irradiance of the vertices, interpolated.
#include "surface.glsl"
in vec3 irradiance_even, irradiance_odd;

vec3 shade(Surface s) {
  vec3 e = irradiance_even + (gl_FrontFacing ? irradiance_odd : -irradiance_odd);
  return s.diffuse / PI * max(e, vec3(0.0));
}

#include "forward.glsl"
