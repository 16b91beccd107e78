// Obscurance from taps around the pixel that lie on surfaces. SPIRAL 0: Alchemy (McGuire, Osman, Bukowski & Hennessy 2011, eq. 10):
//   1 - 2 intensity R / n  sum of max(0, v.n - bias) / (v.v + e).
// SPIRAL 1: scalable ambient obscurance (McGuire, Mara & Luebke 2012): taps on a spiral, far ones read from smaller levels, and
//   1 - 5 intensity R / n  sum of (1 - v.v / R^2)^3 max(0, v.n - bias) / (v.v + e).
// v goes from the surface to the tap; R makes the intensity a pure number.
#ifndef SPIRAL
#define SPIRAL 1
#endif
#include "occlusion_layer.glsl"
uniform int samples;
uniform float intensity, bias;
uniform sampler2D depth_levels;
uniform int last_level;

vec3 tap_position(vec2 tap, float away) {
  ivec2 at = ivec2(floor(tap));
  int level = SPIRAL == 1 ? clamp(int(floor(log2(max(away, 1.0)))) - 3, 0, last_level) : 0;
  if (level == 0) return depth_at(at) > 0.0 ? position_at(at) : vec3(0.0);
  ivec2 small = min(at >> level, (picture_size >> level) - 1);
  int row = 0;
  for (int k = 1; k < level; ++k) row += picture_size.y >> k;
  float depth = texelFetch(depth_levels, small + ivec2(0, row), 0).r;
  ivec2 texel = small;
  for (int k = level; k > 0; --k) texel = 2 * texel + ivec2(texel.y & 1, texel.x & 1);
  return depth > 0.0 ? view_position(vec2(min(texel, picture_size - 1)) + 0.5, depth) : vec3(0.0);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth <= 0.0) { openness = vec4(0.0, 0.0, 0.0, 1.0); return; }
  vec3 position = view_position(vec2(pixel) + 0.5, depth), normal = normal_at(pixel);
  vec2 noise = pattern(pixel);
  float reach = radius_in_pixels(depth), sum = 0.0, margin = bias * depth;
  for (int i = 0; i < samples; ++i) {
    float share = (float(i) + noise.y) / float(samples);
    float away = max(1.0, reach * (SPIRAL == 1 ? share : sqrt(share)));
    float angle = 2.0 * PI * (SPIRAL == 1 ? share * 7.0 + noise.x : float(i) * 0.6180339887 + noise.x);
    vec2 tap = vec2(pixel) + 0.5 + away * vec2(cos(angle), sin(angle));
    if (outside(ivec2(floor(tap)))) continue;
    vec3 there = tap_position(tap, away);
    if (there.z == 0.0) continue;
    vec3 v = there - position;
    float vv = dot(v, v), up = max(0.0, dot(v, normal) - margin), fade = 1.0 - vv / (radius * radius);
    if (fade <= 0.0) continue;
    sum += (SPIRAL == 1 ? 5.0 * fade * fade * fade : 2.0) * up / (vv + 1e-4 * radius * radius);
  }
  write_openness(normal, normal, max(0.0, 1.0 - intensity * radius * sum / float(samples)));
}
