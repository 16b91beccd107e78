// Visibility bitmask (Therrien, Levesque & Gilet 2023): 32 sectors of equal angle about the projected normal; a tap hides those between
// its front and its back, `thickness` behind it, so that light passes under thin things.
#include "occlusion_slices.glsl"

// The count is rounded up, as in the paper's listing.
uint sectors(float from, float to) {
  int first = int(clamp(floor(from * 32.0), 0.0, 32.0)), count = int(clamp(ceil((to - from) * 32.0), 0.0, 32.0));
  if (count == 0 || first > 31) return 0u;
  return (0xFFFFFFFFu >> uint(32 - count)) << uint(first);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth <= 0.0) { openness = vec4(0.0, 0.0, 0.0, 1.0); return; }
  vec3 position = view_position(vec2(pixel) + 0.5, depth), normal = normal_at(pixel), view = towards_eye(position);
  vec2 noise = pattern(pixel);
  float reach = radius_in_pixels(depth), hidden = 0.0;
  vec3 bent = vec3(0.0);
  for (int i = 0; i < slices; ++i) {
    Slice s = slice_on_screen(PI * (float(i) + noise.x) / float(slices), view, normal);
    uint mask = 0u;
    for (int j = 0; j < steps; ++j) {
      float jitter = fract(noise.y + float(i + j * slices) * 0.6180339887);
      vec2 offset = round((1.0 + reach * pow((float(j) + jitter) / float(steps), step_power)) * s.screen);
      for (int side = 0; side < 2; ++side) {
        ivec2 tap = pixel + ivec2(side == 0 ? offset : -offset);
        if (outside(tap) || depth_at(tap) <= 0.0) continue;
        vec3 to = position_at(tap) - position, behind = to - thickness * view;
        if (dot(to, to) > radius * radius) continue;
        float sign = side == 0 ? 1.0 : -1.0;
        vec2 angles = sign * acos(clamp(vec2(dot(normalize(to), view), dot(normalize(behind), view)), -1.0, 1.0));
        vec2 shares = clamp((angles - s.angle) / PI + 0.5, 0.0, 1.0);
        mask |= sectors(min(shares.x, shares.y), max(shares.x, shares.y));
      }
    }
    hidden += float(bits_of(mask)) / 32.0;
#ifdef BENT_NORMALS
    for (int b = 0; b < 32; ++b) {
      if ((mask >> uint(b) & 1u) != 0u) continue;
      float angle = PI * ((float(b) + 0.5) / 32.0 - 0.5) + s.angle;
      float weight = s.projected * abs(sin(angle)) * cos(angle - s.angle);
      bent += weight * (sin(angle) * s.tangent + cos(angle) * s.view);
    }
#endif
  }
  write_openness(bent, normal, 1.0 - hidden / float(slices));
}
