// LEAN mapping (Olano & Baker 2010): mean and second moments of slopes, filtered linearly, give a Gaussian of slopes; a Beckmann lobe
// of width alpha is one of variance alpha^2 / 2 in each direction, so both together are the lobe of covariance C + alpha^2 / 2. The paper
// has it lit by points. An environment that is filtered by isotropic lobes allows one look-up of the mean width,
// alpha'^2 = alpha^2 + trace C: this is what anisotropic look-ups are measured against.
#define SMOOTH_NORMAL
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "bump.glsl"

vec3 shade(Surface s) {
  vec3 normal = s.normal;
  float roughness = s.perceptual_roughness;
  if (bump_present) {
    vec4 slopes = texture(bump_slopes, s.normal_uv);
    // The second texture, E[s_x s_y], decides the lobe's direction, which an isotropic look-up does not have.
    vec2 variance = max(slopes.zw - slopes.xy * slopes.xy, 0.0);
    roughness = pow(min(s.alpha * s.alpha + variance.x + variance.y, 1.0), 0.25);
    normal = towards_viewer(bumped_normal(vec3(slopes.xy, 1.0), frame_of_fragment()), s.view);
  }
  return lit_surface(s, normal, roughness, prefiltered_ggx(reflect(-s.view, normal), roughness));
}

#include "forward.glsl"
