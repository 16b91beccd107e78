// Greene 1986: diffuse light is one look-up by the normal.
#include "surface.glsl"
#include "environment.glsl"

vec3 shade(Surface s) { return s.diffuse / PI * irradiance(s.normal); }

#include "forward.glsl"
