// Horizon sectors: a slice's hemisphere is cut into 32 sectors of equal cosine-weighted measure, and every tap hides what the piece of
// surface hides that it stands for: its own plane over its whole stratum of the slice, as thick as said. Derivation:
// docs/realtime-occlusion.md.
#include "occlusion_slices.glsl"

// The sectors from share `from` to `to` of the slice's measure; `shift` in [0, 1) decides whether an end within a sector counts.
uint sectors(float from, float to, float shift) {
  int first = int(floor(from * 32.0 + shift)), last = min(int(floor(to * 32.0 + shift)), 32);
  if (last <= first) return 0u;
  return (0xFFFFFFFFu >> uint(32 - last + first)) << uint(first);
}

// A plane through the view ray, its turn about that ray uniform; it is seen as a line on the screen.
Slice slice_about_view(float turn, vec3 position, vec3 view, vec3 normal) {
  vec3 x = normalize(vec3(view.z, 0.0, -view.x)), y = cross(view, x);
  Slice s;
  s.tangent = cos(turn) * x + sin(turn) * y;
  s.view = view;
  s.across = cross(s.tangent, view);
  s.screen = normalize(orthographic ? s.tangent.xy : s.tangent.xy * -position.z + position.xy * s.tangent.z);
  float t = dot(normal, s.tangent), v = dot(normal, view);
  s.projected = sqrt(t * t + v * v);
  s.angle = atan(t, v);
  return s;
}

// Where the eye's ray through `pixel` meets the plane of a tap, not farther from the tap than `most` along the view axis.
vec3 on_plane(vec2 pixel, vec3 tap, vec3 normal, float most) {
  vec3 here = view_position(pixel, orthographic ? -tap.z : 1.0);
  float slope = orthographic ? normal.z : dot(normal, here);
  float depth = -tap.z;
  if (orthographic) depth += dot(normal.xy, here.xy - tap.xy) / max(slope, 1e-3);
  else depth = dot(normal, tap) / min(slope, -1e-3);
  return view_position(pixel, clamp(depth, -tap.z - most, -tap.z + most));
}

// The part of the way from a to b that lies within the radius, as shares of it; x > y: none.
vec2 within_radius(vec2 a, vec2 b) {
  vec2 d = b - a;
  float q = max(dot(d, d), 1e-20), p = dot(a, d) / q, rest = p * p - (dot(a, a) - radius * radius) / q;
  return rest <= 0.0 ? vec2(1.0, 0.0) : clamp(sqrt(rest) * vec2(-1.0, 1.0) - p, 0.0, 1.0);
}

float angle_of(vec2 p) { return atan(p.x, p.y); }

// Measure of the slice from its lower end to an angle.
float share_below(float angle, float gamma, float c, float s, float below) {
  return below + (angle < 0.0 ? -1.0 : 1.0) * slice_measure(angle, gamma, c, s);
}

#ifdef BENT_NORMALS
// Sum of the open directions at 32 even angles, weighted by what each measures.
vec3 open_direction(uint mask, Slice s, float c, float sine, float below, float total, float shift) {
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 32; ++k) {
    float angle = s.angle + PI * ((float(k) + 0.5) / 32.0 - 0.5);
    int sector = clamp(int(32.0 * share_below(angle, s.angle, c, sine, below) / total + shift), 0, 31);
    if ((mask >> uint(sector) & 1u) == 0u) sum += abs(sin(angle)) * cos(angle - s.angle) * vec2(sin(angle), cos(angle));
  }
  return sum.x * s.tangent + sum.y * s.view;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float depth = depth_at(pixel);
  if (depth <= 0.0) { openness = vec4(0.0, 0.0, 0.0, 1.0); return; }
  vec3 position = view_position(vec2(pixel) + 0.5, depth), normal = normal_at(pixel), view = towards_eye(position);
  vec2 noise = pattern(pixel);
  float reach = radius_in_pixels(depth), open = 0.0, all = 0.0;
  vec3 bent = vec3(0.0);
  for (int i = 0; i < slices; ++i) {
    Slice s = slice_about_view(PI * (float(i) + noise.x) / float(slices), position, view, normal);
    float c = cos(s.angle), sine = sin(s.angle), total = c + s.angle * sine;
    float low = s.angle - 0.5 * PI, high = s.angle + 0.5 * PI, below = slice_measure(low, s.angle, c, sine);
    uint mask = 0u;
    for (int j = 0; j < 2 * steps; ++j) {
      float sign = (j & 1) == 0 ? 1.0 : -1.0, step = float(j >> 1);
      float u = fract(noise.y + float(i) * 0.6180339887 + float(j & 1) * 0.5);
      vec3 edges = 0.5 + reach * pow((step + vec3(0.0, u, 1.0)) / float(steps), vec3(step_power));
      vec2 line = sign * s.screen;
      ivec2 tap = pixel + ivec2(round(max(edges.y, 1.0) * line));
      float there = outside(tap) ? 0.0 : depth_at(tap);
      if (there <= 0.0) continue;
      vec3 seen = view_position(vec2(tap) + 0.5, there), tap_normal = normal_at(tap);
      vec2 middle = vec2(pixel) + 0.5;
      float most = 2.0 * (edges.z - edges.x + 1.0) / pixels_per_metre(there);
      vec3 away = orthographic ? vec3(0.0, 0.0, -1.0) : normalize(seen);
      vec2 behind = thickness * vec2(dot(away, s.tangent), dot(away, view));
      vec3 inner = on_plane(middle + edges.x * line, seen, tap_normal, most) - position;
      vec3 outer = on_plane(middle + edges.z * line, seen, tap_normal, most) - position;
      vec2 p0 = vec2(dot(inner, s.tangent), dot(inner, view)), p1 = vec2(dot(outer, s.tangent), dot(outer, view));
      vec2 part = within_radius(p0, p1);
      if (part.x >= part.y) continue;
      vec2 way = p1 - p0;
      p1 = p0 + part.y * way;
      p0 += part.x * way;
      vec4 angles = sign * vec4(angle_of(p0), angle_of(p1), angle_of(p0 + behind), angle_of(p1 + behind));
      // Behind the pixel's own view ray the angle jumps from pi to -pi: there the back is at pi.
      angles.zw = mix(angles.zw, vec2(PI), lessThan(angles.zw, vec2(0.0)));
      float a = min(min(angles.x, angles.y), min(angles.z, angles.w));
      float b = max(max(angles.x, angles.y), max(angles.z, angles.w));
      vec2 ends = clamp(sign > 0.0 ? vec2(a, b) : vec2(-b, -a), low, high);
      vec2 shares = vec2(share_below(ends.x, s.angle, c, sine, below), share_below(ends.y, s.angle, c, sine, below)) / total;
      mask |= sectors(clamp(shares.x, 0.0, 1.0), clamp(shares.y, 0.0, 1.0), noise.x);
    }
    float weight = s.projected * total;
#ifdef BENT_NORMALS
    bent += s.projected * open_direction(mask, s, c, sine, below, total, noise.x);
#endif
    open += weight * (1.0 - float(bits_of(mask)) / 32.0);
    all += weight;
  }
  write_openness(bent, normal, open / max(all, 1e-6));
}
