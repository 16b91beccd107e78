// Schilling 1997 and 2001: the covariance of the normals under a pixel, kept in the mips of the bump map, becomes an anisotropic footprint
// in the environment. Here: four look-ups whose spread and width together have the footprint's covariance.
//
// 1. The pixel's square as moments. A box of side w has the variance w^2 / 12; the hardware's trilinear kernel at a level whose
//    texels are 2^l wide: box plus tent, 2^2l (1 / 12 + 1 / 6) = 2^2l / 4. They agree for 2^l = w / sqrt 3. A pixel that is l1 by l2 texels,
//    l1 > l2, takes two look-ups at +-d along its longer side, d^2 + l2^2 / 12 = l1^2 / 12.
// 2. Slopes to reflected directions. n = N / |N| with N = s_x T + s_y B + Z, so dn/ds_x = (T - n (n.T)) / |N|, and r = 2 (n.v) n - v
//    gives dr = 2 (dn.v) n + 2 (n.v) dn. For a turn a in the plane of incidence and b across it, dn = a t + b u with v = cos n + sin t:
//    dr = 2 a (sin n + cos t) + 2 b cos u. So angles double in the plane and are 2 cos theta wide across it. In a frame (f1, f2) across r,
//    f1 along dr/ds_x, J is triangular, and the directions' covariance is A = J C J^T.
// 3. Curvature and view divergence: the mesh's own reflection moves by p_x and p_y from pixel to pixel, which adds
//    (p_x p_x^T + p_y p_y^T) / 12.
// 4. Eigenvalues l1 >= l2 of A, axes e1, e2. Each look-up is a round kernel of variance t; four of equal weight at +-p, +-q along e1 and
//    +1, +1, -1, -1 along e2 (no correlation) in units of sqrt(l1 - t) and sqrt(l2 - t), p^2 + q^2 = 2: the sum has the
//    covariance A whatever t is. p : q goes from 1 : 1, a square, to 3 : 1, a row. Narrow t would leave gaps: in a row neighbours are
//    2 sqrt((l1 - t) / 5) apart, and t >= 0.12 l1 keeps them within 2.4 standard deviations; the surface's own lobe fills gaps as well.
// 5. Offsets are taken back to slopes, J^-1 e, and each look-up reflects exactly at its slope: large tilts bend the footprint as they should.
// 6. A GGX lobe of half vectors has slopes' variance alpha^2 / 2, of directions' 2 alpha^2: the filtered chain is read at alpha^2 + t / 2. A
//    mirror reads the box mips, which have no tails: a texel of an N x N face is 2 m^1.5 / N wide, m the direction's largest component,
//    and its trilinear kernel has the standard deviation of half a texel.
#define SMOOTH_NORMAL
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "bump.glsl"

uniform float environment_size;

struct Slopes {
  vec2 mean, variance;
  float covariance;
};

Slopes slopes_under_pixel(vec2 uv) {
  vec2 across = dFdx(uv) * bump_size, down = dFdy(uv) * bump_size;
  float across2 = dot(across, across), down2 = dot(down, down), long2 = max(max(across2, down2), 1e-12);
  float area = across.x * down.y - across.y * down.x;
  float short2 = max(area * area / long2, long2 / 6.25);  // two look-ups cannot cover more
  vec2 offset = sqrt((long2 - min(short2, long2)) / (12.0 * long2)) * (across2 > down2 ? across : down) / bump_size;
  float level = 0.5 * log2(short2 / 3.0);
  vec4 moments = 0.5 * (textureLod(bump_slopes, uv + offset, level) + textureLod(bump_slopes, uv - offset, level));
  float product = 0.5 * (textureLod(bump_shapes, uv + offset, level).x + textureLod(bump_shapes, uv - offset, level).x);
  vec2 variance = max(moments.zw - moments.xy * moments.xy, 1e-8);
  float limit = 0.999 * sqrt(variance.x * variance.y);
  return Slopes(moments.xy, variance, clamp(product - moments.x * moments.y, -limit, limit));
}

vec3 look_up(Surface s, vec2 slope, mat3 frame, float variance) {
  vec3 r = reflect(-s.view, towards_viewer(bumped_normal(vec3(slope, 1.0), frame), s.view));
  if (s.perceptual_roughness > 0.01) return prefiltered_ggx(r, pow(min(s.alpha * s.alpha + 0.5 * variance, 1.0), 0.25));
  r = in_map(r);
  float m = max(abs(r.x), max(abs(r.y), abs(r.z)));
  return textureLod(environment_map, r, log2(environment_size * sqrt(max(variance, 1e-12))) - 1.5 * log2(m)).rgb;
}

vec3 shade(Surface s) {
  if (!bump_present) return lit_surface(s, s.normal, s.perceptual_roughness, prefiltered_ggx(reflect(-s.view, s.normal), s.perceptual_roughness));
  mat3 frame = frame_of_fragment();
  Slopes c = slopes_under_pixel(s.normal_uv);
  // 2: J
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 raw = side * c.mean.x * frame[0] + side * c.mean.y * frame[1] + frame[2];
  vec3 n = towards_viewer(normalize(raw), s.view);
  float cosine = dot(n, s.view), per_slope = side / length(raw);
  vec3 nx = per_slope * (frame[0] - dot(n, frame[0]) * n), ny = per_slope * (frame[1] - dot(n, frame[1]) * n);
  vec3 rx = 2.0 * (dot(nx, s.view) * n + cosine * nx), ry = 2.0 * (dot(ny, s.view) * n + cosine * ny);
  vec3 f1 = normalize(rx), f2 = cross(reflect(-s.view, n), f1);
  float j11 = dot(rx, f1), j12 = dot(ry, f1), j22 = dot(ry, f2);
  j22 = abs(j22) < 1e-4 ? 1e-4 : j22;
  // A = J C J^T, and 3
  vec3 own = reflect(-s.view, s.normal), px = dFdx(own), py = dFdy(own);
  vec2 p1 = vec2(dot(px, f1), dot(py, f1)), p2 = vec2(dot(px, f2), dot(py, f2));
  float a11 = j11 * j11 * c.variance.x + 2.0 * j11 * j12 * c.covariance + j12 * j12 * c.variance.y + dot(p1, p1) / 12.0;
  float a12 = j22 * (j11 * c.covariance + j12 * c.variance.y) + dot(p1, p2) / 12.0;
  float a22 = j22 * j22 * c.variance.y + dot(p2, p2) / 12.0;
  // 4
  float middle = 0.5 * (a11 + a22), half_gap = length(vec2(0.5 * (a11 - a22), a12));
  float l1 = middle + half_gap, l2 = max(middle - half_gap, 1e-4 * l1);
  vec2 e1 = a11 > a22 ? vec2(l1 - a22, a12) : vec2(a12, l1 - a11);
  e1 = dot(e1, e1) > 1e-20 ? normalize(e1) : vec2(1.0, 0.0);
  float t = clamp(max(0.8 * l2, 0.12 * l1 - 2.0 * s.alpha * s.alpha), 0.0, l1);
  float spread1 = sqrt(l1 - t), spread2 = sqrt(max(l2 - t, 0.0));
  float q = mix(0.44721, 1.0, smoothstep(0.3, 1.0, spread2 / max(spread1, 1e-6))), p = sqrt(2.0 - q * q);
  // 5
  vec2 u1 = spread1 * vec2((e1.x - j12 * e1.y / j22) / j11, e1.y / j22);
  vec2 u2 = spread2 * vec2((-e1.y - j12 * e1.x / j22) / j11, e1.x / j22);
  vec3 sum = look_up(s, c.mean + p * u1 + u2, frame, t) + look_up(s, c.mean - p * u1 + u2, frame, t) +
             look_up(s, c.mean + q * u1 - u2, frame, t) + look_up(s, c.mean - q * u1 - u2, frame, t);
  return lit_surface(s, n, s.perceptual_roughness, 0.25 * sum);
}

#include "forward.glsl"
