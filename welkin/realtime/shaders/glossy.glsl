// Radiance filtered by a lobe of a perceptual roughness, from maps that were made in this frame (capture/glossy_maps.h).
#include "cube_faces.glsl"
const int GLOSSY_CUBE = 0, GLOSSY_FACES = 1, GLOSSY_PARABOLOIDS = 2, GLOSSY_FILTERED = 3;
uniform int glossy_kind;
uniform samplerCube glossy_cube;
uniform sampler2DArray glossy_faces;
uniform float glossy_spreads[17];  // of the lobe, radians, by roughness * 16
uniform float glossy_texels;       // along an edge of a face, or over a paraboloid's diameter, at level 0
uniform float glossy_reach;        // pictures go from -reach to reach; faces and discs from -1 to 1
uniform float glossy_last_level;

float glossy_spread(float perceptual_roughness) {
  float x = 16.0 * clamp(perceptual_roughness, 0.0, 1.0);
  int i = min(int(x), 15);
  return mix(glossy_spreads[i], glossy_spreads[i + 1], x - float(i));
}

// The level of a mip chain whose look-up is as wide as the lobe (docs/approximate-filters.md): log2(texels * spread) + bias, clamped.
float glossy_level(float spread, float bias) {
  return clamp(log2(max(glossy_texels * spread, 1e-6)) + bias, 0.0, glossy_last_level);
}

vec3 glossy_picture(vec2 at, float layer, float level) {
  return textureLod(glossy_faces, vec3(0.5 + 0.5 * at / glossy_reach, layer), level).rgb;
}

// Levels of the filtered chain have lobes of half the spread each, from the widest at the last, and level 0 is the capture itself; between two the variance is right.
float glossy_filtered_level(float spread) {
  float x = glossy_last_level + log2(max(spread / glossy_spreads[16], 1e-6));
  if (x < 1.0) return exp2(2.0 * (x - 1.0));
  return min(floor(x) + (exp2(2.0 * fract(x)) - 1.0) / 3.0, glossy_last_level);
}

vec3 glossy_radiance(vec3 direction, float perceptual_roughness) {
  float spread = glossy_spread(perceptual_roughness);
  if (glossy_kind == GLOSSY_FILTERED) return textureLod(glossy_cube, direction, glossy_filtered_level(spread)).rgb;
  if (glossy_kind == GLOSSY_CUBE) return textureLod(glossy_cube, direction, glossy_level(spread, 0.65)).rgb;
  if (glossy_kind == GLOSSY_FACES) {
    vec3 place = cube_place(direction);
    return glossy_picture(place.xy, place.z, glossy_level(spread, 0.65));
  }
  // Kautz et al. 2000: the kernel of the middle and the one of the rim, twice as large, blended so that the variance is right: at radius r it is
  // (1 + r^2)^2 = 1 + 3 share times the middle's. A unit of the picture is an angle of 2 there, so a texel is 4 / texels.
  vec3 d = normalize(direction);
  vec2 at = vec2(d.x, -d.y) / (1.0 + abs(d.z));
  float growth = 1.0 + dot(at, at), share = (growth * growth - 1.0) / 3.0;
  float layer = d.z < 0.0 ? 1.0 : 0.0, level = glossy_level(0.5 * spread, 0.183);
  return mix(glossy_picture(at, layer, level), glossy_picture(at, layer, min(level + 1.0, glossy_last_level)), share);
}
