// A stack of maps, one or two for each elevation of the view, filtered with the lobes that fit the BRDF there (Kautz &
// McCool 2000; welkin/brdf/lobe_fit.h). The maps are octahedral slices of a 3-D texture with a border of one texel, so
// that its sampler also blends the two elevations next to the view's.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"

const int VIEWS = 16;
uniform highp sampler3D stack_map;       // slice j VIEWS + i: lobe j of view i, times its share of that view's energy
uniform vec3 stack_views[VIEWS];         // angle of the view and of the axes of both lobes, rad from the normal
uniform int stack_lobes;                 // 0: the material has no stack, the chain is looked up
uniform float stack_size;                // texels along an edge without the borders

vec2 octahedral(vec3 d) {
  d /= abs(d.x) + abs(d.y) + abs(d.z);
  vec2 side = vec2(d.x >= 0.0 ? 1.0 : -1.0, d.z >= 0.0 ? 1.0 : -1.0);
  vec2 p = d.y >= 0.0 ? d.xz : (1.0 - abs(d.zx)) * side;
  return (0.5 + 0.5 * p) * (stack_size / (stack_size + 2.0)) + 1.0 / (stack_size + 2.0);
}

vec3 stack_radiance(Surface s, float cos_view) {
  float angle = acos(cos_view);
  vec3 across = cos_view * s.normal - s.view;  // away from the view
  vec3 away = dot(across, across) > 1e-10 ? normalize(across) : vec3(0.0);
  int first = 0;
  for (int i = 1; i < VIEWS - 1; ++i) first = angle >= stack_views[i].x ? i : first;
  vec3 from = stack_views[first], to = stack_views[first + 1];
  float share = clamp((angle - from.x) / (to.x - from.x), 0.0, 1.0);
  vec3 axes = mix(from, to, share), sum = vec3(0.0);
  for (int j = 0; j < 2; ++j) {
    if (j >= stack_lobes) break;
    float axis = j == 0 ? axes.y : axes.z;
    vec3 direction = cos(axis) * s.normal + sin(axis) * away;
    float slice = (float(j * VIEWS + first) + share + 0.5) / float(stack_lobes * VIEWS);
    sum += textureLod(stack_map, vec3(octahedral(in_map(direction)), slice), 0.0).rgb;
  }
  return sum;
}

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  vec2 dfg = look_up_dfg(cos_view, s.perceptual_roughness);
  vec3 glossy = stack_lobes > 0 ? stack_radiance(s, cos_view)
                                : prefiltered_ggx(reflect(-s.view, s.normal), s.perceptual_roughness);
  return reflected_share(dfg, s.f0, s.f90, material_compensated) * glossy +
         coat_transmission(s, dfg) * s.diffuse / PI * irradiance(s.normal);
}

#include "forward.glsl"
