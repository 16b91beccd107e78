// A face of a level of the filtered chain: weighted look-ups around the direction, turned by its east and north. The level of each tap is given, or follows from how wide its footprint
// is to be where it falls (welkin/envmap/methods/quick.h).
#include "cube_faces.glsl"
uniform samplerCube chain;
uniform int face, taps;
uniform float size;                // of the level that is drawn
uniform float chain_size;          // texels of the chain's level 0
uniform bool by_footprint;
uniform vec3 tap_directions[64];   // z along the direction
uniform vec3 tap_sizes[64];        // footprint's deviation (radians) or level, weight
layout(location = 0) out vec4 radiance;

// Level k has the variance 5/12 4^k - 1/6 in texels of level 0; between levels it is linear in the share of the upper one.
float level_of_footprint(vec3 direction, float deviation) {
  float largest = max(max(abs(direction.x), abs(direction.y)), abs(direction.z));
  float r3 = 1.0 / (largest * largest * largest);
  float wanted = max(1.0, (0.25 * deviation * deviation * chain_size * chain_size * r3 + 1.0 / 6.0) * 2.4);
  float level = floor(0.5 * log2(wanted) + 1e-5);
  return level + clamp((wanted * exp2(-2.0 * level) - 1.0) / 3.0, 0.0, 1.0);
}

void main() {
  vec3 up = normalize(cube_ray(face, 2.0 * gl_FragCoord.xy / size - 1.0));
  float flat_length = length(up.xz);
  vec3 east = flat_length > 0.0 ? vec3(up.z, 0.0, -up.x) / flat_length : vec3(1.0, 0.0, 0.0), north = cross(up, east);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < taps; ++i) {
    vec3 local = tap_directions[i], direction = local.x * east + local.y * north + local.z * up;
    float level = by_footprint ? level_of_footprint(direction, tap_sizes[i].x) : tap_sizes[i].x;
    sum += tap_sizes[i].y * textureLod(chain, direction, level).rgb;
  }
  radiance = vec4(sum, 1.0);
}
