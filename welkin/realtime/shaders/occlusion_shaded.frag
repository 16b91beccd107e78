// Diffuse surfaces under the irradiance map, dimmed by screen-space openness; looked up by the bent normal or the normal.
#include "surface.glsl"
#include "environment.glsl"
#include "screen_occlusion.glsl"
uniform bool show_openness, use_bent_normal;
uniform float power;
layout(location = 0) out vec4 radiance;

void main() {
  Surface s = surface_of_fragment();
  vec4 open = openness_of_fragment();
  float share = pow(clamp(open.a, 0.0, 1.0), power);
  vec3 direction = use_bent_normal ? normalize(open.rgb) : s.normal;
  vec3 shaded = share * s.diffuse / PI * irradiance(direction) + s.emission;
  radiance = vec4(show_openness ? vec3(share) : shaded, 1.0);
}
