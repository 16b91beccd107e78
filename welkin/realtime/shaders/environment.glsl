// The environment's maps. `in_map` turns a direction of the world into one of the maps (the environment may be rotated).
uniform mat3 world_to_environment;
uniform samplerCube environment_map;   // radiance, full chain of box mips
uniform samplerCube specular_map;      // radiance filtered by the GGX lobe, level = perceptual roughness * specular_last_level
uniform samplerCube irradiance_map;    // E
uniform sampler2D dfg_map;             // (scale, bias) at (n.v, perceptual roughness)
uniform float specular_last_level, environment_last_level;
uniform vec3 radiance_sh[9];           // of the radiance, index l(l+1)+m; nothing convolved

vec3 in_map(vec3 direction) { return world_to_environment * direction; }

vec3 environment_radiance(vec3 direction) { return textureLod(environment_map, in_map(direction), 0.0).rgb; }

vec3 irradiance(vec3 normal) { return textureLod(irradiance_map, in_map(normal), 0.0).rgb; }

vec3 prefiltered_ggx(vec3 direction, float perceptual_roughness) {
  return textureLod(specular_map, in_map(direction), perceptual_roughness * specular_last_level).rgb;
}
