// A picture beside its reference or their difference in colours (viewer/viewer_state.h has the modes).
#include "tone_curves.glsl"
in vec2 uv;
uniform sampler2D picture;
uniform sampler2D reference;
uniform int mode;       // 0 picture, 1 reference, 2 split, 3 signed difference, 4 difference
uniform float split;    // in widths, from the left
uniform float pixel;    // a pixel of what is drawn to, in widths
uniform float scale;    // radiance at the end of the colours
uniform vec3 stops[7];  // the colours, as shown
layout(location = 0) out vec4 color;

vec3 false_color(float position) {
  float at = clamp(position, 0.0, 1.0) * 6.0;
  int below = min(int(at), 5);
  return mix(stops[below], stops[below + 1], at - float(below));
}

// As stripes where there is no surface, which has no difference.
vec3 difference_color(vec4 a, vec4 b) {
  if (a.a < 0.5 || b.a < 0.5) {
    vec2 stripe = floor(gl_FragCoord.xy / 4.0);
    return vec3(mod(stripe.x + stripe.y, 2.0) == 0.0 ? 0.16 : 0.13);
  }
  vec3 d = finite_radiance(a.rgb) - finite_radiance(b.rgb);
  if (mode == 3) return false_color(0.5 + 0.5 * dot(d, vec3(0.2126, 0.7152, 0.0722)) / scale);
  return false_color(max(abs(d.r), max(abs(d.g), abs(d.b))) / scale);
}

void main() {
  vec4 a = texture(picture, uv), b = texture(reference, uv);
  if (mode >= 3) {
    color = vec4(difference_color(a, b), 1.0);
    return;
  }
  bool other = mode == 1 || (mode == 2 && uv.x >= split);
  vec3 shown = tone_mapped(other ? b.rgb : a.rgb);
  if (mode == 2 && abs(uv.x - split) < pixel) shown = vec3(1.0) - step(0.5, dot(shown, vec3(1.0 / 3.0)));
  color = vec4(shown, 1.0);
}
