// Points about the surface compared with the depth layer. HEMISPHERE 0: in the whole ball, the normal unused, so that half of
// the points of a flat wall lie behind it and it comes out half open, as published (Mittring 2007). HEMISPHERE 1: on the side of
// the normal, nearer points more often (by the square of their number). Where falloff > 0 an occluder whose distance along the
// view differs by more than the radius counts less: the range check, s(radius / difference), s(x) = smoothstep(1 - falloff, 1, x).
#ifndef HEMISPHERE
#define HEMISPHERE 1
#endif
#include "occlusion_layer.glsl"
uniform int samples;

vec3 unit_direction(vec2 u, bool half_only) {
  float z = half_only ? u.x : 1.0 - 2.0 * u.x, across = sqrt(max(0.0, 1.0 - z * z));
  return vec3(across * cos(2.0 * PI * u.y), across * sin(2.0 * PI * u.y), z);
}

mat3 frame_about(vec3 normal) {
  vec3 tangent = normalize(abs(normal.y) < 0.9 ? cross(vec3(0, 1, 0), normal) : cross(vec3(1, 0, 0), normal));
  return mat3(tangent, cross(normal, tangent), normal);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth <= 0.0) { openness = vec4(0.0, 0.0, 0.0, 1.0); return; }
  vec3 position = view_position(vec2(pixel) + 0.5, depth), normal = normal_at(pixel), bent = vec3(0.0);
  mat3 frame = HEMISPHERE == 1 ? frame_about(normal) : mat3(1.0);
  vec2 turn = pattern(pixel);
  float reach = radius_in_pixels(depth) / pixels_per_metre(depth), hidden = 0.0;
  float margin = 0.5 * length(view_window.zw / vec2(picture_size)) * (orthographic ? 1.0 : depth);
  for (int i = 0; i < samples; ++i) {
    float share = (float(i) + turn.y) / float(samples);
    vec3 direction = frame * unit_direction(vec2(share, fract(radical_inverse(i) + turn.x)), HEMISPHERE == 1);
    float at = fract(float(i) * 0.618034 + turn.y);
    float far = HEMISPHERE == 1 ? mix(0.05, 1.0, at * at) : pow(at, 1.0 / 3.0);
    vec3 point = position + reach * far * direction;
    ivec2 seen = ivec2(floor(pixel_of(point)));
    float there = outside(seen) || point.z >= 0.0 ? 0.0 : depth_at(seen);
    float behind = -point.z - there;
    bool blocked = there > 0.0 && behind > (HEMISPHERE == 1 ? margin : 0.0) && seen != pixel;
    if (HEMISPHERE == 0 && seen == pixel) blocked = behind > 0.0;
    float weight = 1.0;
    if (falloff > 0.0) weight = smoothstep(1.0 - falloff, 1.0, reach / max(abs(there - depth), 1e-9));
    hidden += blocked ? weight : 0.0;
    bent += (blocked ? 1.0 - weight : 1.0) * direction;
  }
  write_openness(HEMISPHERE == 1 ? bent : normal, normal, 1.0 - hidden / float(samples));
}
