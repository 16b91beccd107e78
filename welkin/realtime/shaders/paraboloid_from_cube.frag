// Both paraboloids, side by side as the map of welkin/sphere/mapping.h (row 0: b = 1), from a cube: each texel the mean of four look-ups.
uniform samplerCube cube;
uniform float size;  // texels across a paraboloid
layout(location = 0) out vec4 radiance;

void main() {
  float side = gl_FragCoord.x < size ? 1.0 : -1.0;
  vec2 texel = vec2(mod(gl_FragCoord.x, size), gl_FragCoord.y) - 0.5;
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) {
    vec2 at = 2.0 * (texel + vec2(k % 2 == 0 ? 0.25 : 0.75, k < 2 ? 0.25 : 0.75)) / size - 1.0;
    float scale = 2.0 / (1.0 + dot(at, at));
    sum += textureLod(cube, vec3(at.x * scale, -at.y * scale, side * (scale - 1.0)), 0.0).rgb;
  }
  radiance = vec4(0.25 * sum, 1.0);
}
