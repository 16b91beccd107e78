// Adds the surfaces in a picture of `scale` x `scale` samples a pixel to what was added before. Alpha counts the share of surface.
in vec2 uv;
uniform sampler2D samples, before;
uniform int scale;
uniform bool first;
layout(location = 0) out vec4 sum;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  sum = vec4(0.0);
  for (int y = 0; y < scale; ++y)
    for (int x = 0; x < scale; ++x) sum += texelFetch(samples, pixel * scale + ivec2(x, y), 0);
  sum /= float(scale * scale);
  if (!first) sum += texelFetch(before, pixel, 0);
}
