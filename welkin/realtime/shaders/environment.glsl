// The environment's maps. `in_map` turns a direction of the world into one of the maps (the environment may be rotated).
uniform mat3 world_to_environment;
uniform samplerCube environment_map;   // radiance, full chain of box mips
uniform samplerCube specular_map;      // radiance filtered by the GGX lobe, at specular_level(perceptual roughness)
uniform samplerCube irradiance_map;    // E
uniform sampler2D dfg_map;             // (scale, bias) at (n.v, perceptual roughness)
uniform float specular_last_level, environment_last_level;
uniform int specular_law;              // LevelLaw: 0 linear, 1 quadratic, 2 log2
uniform float specular_size;           // of its level 0, texels
uniform vec3 radiance_sh[9];           // of the radiance, index l(l+1)+m; nothing convolved

vec3 in_map(vec3 direction) { return world_to_environment * direction; }

vec3 environment_radiance(vec3 direction) { return textureLod(environment_map, in_map(direction), 0.0).rgb; }

vec3 irradiance(vec3 normal) { return textureLod(irradiance_map, in_map(normal), 0.0).rgb; }

float specular_level(float perceptual_roughness) {
  if (specular_law == 0) return perceptual_roughness * specular_last_level;
  if (specular_law == 1) return perceptual_roughness * (2.0 - perceptual_roughness) * specular_last_level;
  float texels = specular_size * perceptual_roughness * perceptual_roughness;
  return clamp(log2(max(texels, 1.0)), 0.0, specular_last_level);
}

vec3 prefiltered_ggx(vec3 direction, float perceptual_roughness) {
  return textureLod(specular_map, in_map(direction), specular_level(perceptual_roughness)).rgb;
}
