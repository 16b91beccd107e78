// King 2005, listing 10-3: convolution and inverse transform of one face of a cube: the sum of the coefficients times a table, which has a tile for each: what the lobe
// multiplies its degree by, times Y_i at the texel.
uniform sampler2D table, coefficients;
uniform int face, size, tiles;
layout(location = 0) out vec4 radiance;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) + ivec2(0, face * size), tile = ivec2(size, 6 * size);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < tiles * tiles; ++i)
    sum += texelFetch(table, ivec2(i % tiles, i / tiles) * tile + at, 0).r * texelFetch(coefficients, ivec2(i, 0), 0).rgb;
  radiance = vec4(sum, 1.0);
}
