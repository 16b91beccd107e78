// A GGX lobe made of three look-ups of the prefiltered chain, spread in the plane of incidence (docs/reflection.md;
// welkin/envmap/reflection/stretched_taps.h). A tap has a place: an offset along the plane of incidence and a roughness
// (a level), and a weight F0 scale + f90 bias. The table has a block of rows for each of the two, tap after tap.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"

const int TAPS = 3;
uniform sampler2D taps_map;  // x = sqrt(n.v), y = perceptual roughness in 2 TAPS blocks
uniform float taps_rows;     // texels of a block

vec3 tapped_radiance(vec3 n, vec3 view, float cos_view, vec3 f0, vec3 f90, float perceptual_roughness) {
  vec3 mirrored = reflect(-view, n);
  float half_texel = 0.5 / taps_rows;  // no block bleeds into the next
  vec2 at = vec2(sqrt(cos_view), clamp(perceptual_roughness, half_texel, 1.0 - half_texel));
  vec3 sum = vec3(0.0), weights = vec3(0.0);
  for (int k = 0; k < TAPS; ++k) {
    vec2 place = textureLod(taps_map, vec2(at.x, (at.y + float(2 * k)) / float(2 * TAPS)), 0.0).rg;
    vec2 share = textureLod(taps_map, vec2(at.x, (at.y + float(2 * k + 1)) / float(2 * TAPS)), 0.0).rg;
    vec3 weight = f0 * share.r + f90 * share.g;
    sum += weight * prefiltered_ggx(mirrored + place.r * (cos_view * mirrored - n), place.g);
    weights += weight;
  }
  return max(sum, vec3(0.0)) / max(weights, vec3(1e-6));
}

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  vec2 dfg = look_up_dfg(cos_view, s.perceptual_roughness);
  vec3 glossy = s.perceptual_roughness < 1e-3
                    ? prefiltered_ggx(reflect(-s.view, s.normal), 0.0)
                    : tapped_radiance(s.normal, s.view, cos_view, s.f0, s.f90, s.perceptual_roughness);
  return reflected_share(dfg, s.f0, s.f90, material_compensated) * glossy +
         coat_transmission(s, dfg) * s.diffuse / PI * irradiance(s.normal);
}

#include "forward.glsl"
