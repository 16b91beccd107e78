// A texel of a map in the layout of welkin/sphere/mapping.h: a cube (six faces below each other, INPUT_CUBE) or two paraboloids.
#ifdef INPUT_CUBE
#include "cube_faces.glsl"
uniform samplerCube radiance_map;

// Row y of all six faces; size texels along an edge. The look-up is at a texel's centre, so nothing is mixed.
vec3 map_texel(int x, int y, int size) {
  int face = y / size;
  vec2 at = (2.0 * vec2(x, y - face * size) + 1.0) / float(size) - 1.0;
  return textureLod(radiance_map, cube_ray(face, at), 0.0).rgb;
}
#else
uniform sampler2D radiance_map;

vec3 map_texel(int x, int y, int size) { return texelFetch(radiance_map, ivec2(x, y), 0).rgb; }
#endif
