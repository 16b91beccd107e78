// Glossy by maps filtered with Phong's lobe (Heidrich & Seidel 1999), the exponent pixel by pixel.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "power_lobe.glsl"

vec3 shade(Surface s) {
  return material_power != POWER_NONE ? power_material(s, reflect(-s.view, s.normal)) : power_shade_other(s);
}

#include "forward.glsl"
