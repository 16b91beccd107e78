// The mean of the samples that met a surface. Drawn where there is one at the pixel's centre.
in vec2 uv;
uniform sampler2D sum;
layout(location = 0) out vec4 radiance;

void main() {
  vec4 total = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
  radiance = vec4(total.rgb / max(total.a, 1e-6), 1.0);
}
