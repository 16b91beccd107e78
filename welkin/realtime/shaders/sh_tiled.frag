// King 2005, listing 10-2: pixel i of a row of (degree + 1)^2 is coefficient i, the sum over all texels of radiance times a look-up table, which
// has a tile for each i: Y_i times the texel's solid angle. Sums of rows are kept apart, so that little is lost to rounding.
#include "map_texel.glsl"
uniform sampler2D table;
uniform int size, width, height, tiles;  // tiles: in a row of the table
layout(location = 0) out vec4 coefficient;

void main() {
  int i = int(gl_FragCoord.x);
  ivec2 tile = ivec2((i % tiles) * width, (i / tiles) * height);
  vec3 sum = vec3(0.0);
  for (int y = 0; y < height; ++y) {
    vec3 row = vec3(0.0);
    for (int x = 0; x < width; ++x) row += texelFetch(table, tile + ivec2(x, y), 0).r * map_texel(x, y, size);
    sum += row;
  }
  coefficient = vec4(sum, 1.0);
}
