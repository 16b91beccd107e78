// The sum of a progressive picture over its samples, with its depth.
in vec2 uv;
uniform sampler2D sum_map, depth_map;
uniform float samples;
layout(location = 0) out vec4 radiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 sum = texelFetch(sum_map, pixel, 0);
  if (sum.a == 0.0) discard;
  radiance = vec4(sum.rgb / samples, 1.0);
  gl_FragDepth = texelFetch(depth_map, pixel, 0).r;
}
