// Ground-truth ambient occlusion (Jimenez, Wu, Pesce & Jarabo 2016): the highest occluder on each side of a slice hides all below it,
// and the cosine-weighted integral between the two horizons has a closed form. `falloff`: part of the radius over which a tap
// sinks to the ground; `thin` (their thickness heuristic): how fast a horizon sinks again behind a thin occluder.
#include "occlusion_slices.glsl"
uniform float thin;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth <= 0.0) { openness = vec4(0.0, 0.0, 0.0, 1.0); return; }
  vec3 position = view_position(vec2(pixel) + 0.5, depth), normal = normal_at(pixel), view = towards_eye(position);
  vec2 noise = pattern(pixel);
  float reach = radius_in_pixels(depth), nearest = 1.3, open = 0.0;
  vec3 bent = vec3(0.0);
  if (reach <= nearest) { write_openness(normal, normal, 1.0); return; }
  for (int i = 0; i < slices; ++i) {
    Slice s = slice_on_screen(PI * (float(i) + noise.x) / float(slices), view, normal);
    float c = cos(s.angle), sine = sin(s.angle);
    vec2 lowest = vec2(-sine, sine), horizon = lowest;  // cosines, of the side along the slice and of the other
    for (int j = 0; j < steps; ++j) {
      float jitter = fract(noise.y + float(i + j * slices) * 0.6180339887);
      float at = nearest + reach * pow((float(j) + jitter) / float(steps), step_power);
      vec2 offset = round(at * s.screen);
      for (int side = 0; side < 2; ++side) {
        ivec2 tap = pixel + ivec2(side == 0 ? offset : -offset);
        if (outside(tap) || depth_at(tap) <= 0.0) continue;
        vec3 to = position_at(tap) - position;
        float far = length(to), weight = clamp((radius - far) / max(falloff * radius, 1e-6), 0.0, 1.0);
        float found = mix(lowest[side], dot(to, view) / far, weight);
        horizon[side] = found > horizon[side] ? found : mix(horizon[side], found, thin);
      }
    }
    float first = acos(clamp(horizon.x, -1.0, 1.0)), second = -acos(clamp(horizon.y, -1.0, 1.0));
    open += s.projected * (slice_measure(first, s.angle, c, sine) + slice_measure(second, s.angle, c, sine));
    vec2 mean = slice_direction(first, c, sine) + slice_direction(second, c, sine);
    bent += s.projected * (mean.x * s.tangent + mean.y * s.view);
  }
  write_openness(bent, normal, open / float(slices));
}
