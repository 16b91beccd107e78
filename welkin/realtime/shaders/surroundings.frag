// What stands around the object that is lit: diffuse, seen from its front only, lit by the flares (far spheres: pi L (r/d)^2 times the cosine; nothing
// is in the way) and by an irradiance map.
#include "constants.glsl"
in vec3 world_position;
in vec3 world_normal;
uniform vec3 eye_position;
uniform vec3 material_base_color, material_emission;
uniform vec3 flare_places[4], flare_intensities[4];  // intensity: pi r^2 L
uniform samplerCube ambient_map;
uniform float ambient_scale;
#ifdef PARABOLOID
in float ahead;  // cosine to the axis of the paraboloid, interpolated
#endif
layout(location = 0) out vec4 radiance;  // alpha 0: not of the scene that is compared

void main() {
  vec3 normal = normalize(world_normal);
  if (dot(normal, eye_position - world_position) <= 0.0) discard;
#ifdef PARABOLOID
  if (ahead < -0.3) discard;
#endif
  vec3 e = ambient_scale * max(textureLod(ambient_map, normal, 0.0).rgb, 0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 to_flare = flare_places[i] - world_position;
    float squared = max(dot(to_flare, to_flare), 1e-8);
    e += flare_intensities[i] * max(dot(normal, to_flare), 0.0) / (squared * sqrt(squared));
  }
  radiance = vec4(min(material_emission + material_base_color / PI * e, vec3(65504.0)), 0.0);
}
