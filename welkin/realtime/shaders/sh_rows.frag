// First stage of two: pixel (g, y) sums row y of the map for the four coefficients 4 g to 4 g + 3, whose table entries are the four channels of tile g
// (the tiles stand below each other): a texel is fetched a quarter as often as by one pass, and there are pixels enough for every processor.
#include "map_texel.glsl"
uniform sampler2D table;
uniform int size, width, height;
layout(location = 0) out vec4 sum0;
layout(location = 1) out vec4 sum1;
layout(location = 2) out vec4 sum2;
layout(location = 3) out vec4 sum3;

void main() {
  int y = int(gl_FragCoord.y), first = int(gl_FragCoord.x) * height + y;
  vec3 a = vec3(0.0), b = a, c = a, d = a;
  for (int x = 0; x < width; ++x) {
    vec3 radiance = map_texel(x, y, size);
    vec4 weights = texelFetch(table, ivec2(x, first), 0);
    a += weights.x * radiance;
    b += weights.y * radiance;
    c += weights.z * radiance;
    d += weights.w * radiance;
  }
  sum0 = vec4(a, 1.0);
  sum1 = vec4(b, 1.0);
  sum2 = vec4(c, 1.0);
  sum3 = vec4(d, 1.0);
}
