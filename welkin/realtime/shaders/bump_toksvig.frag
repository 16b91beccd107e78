// Toksvig 2005. Unit normals that differ have a mean N shorter than 1. For a Gaussian spread of variance v (per direction)
// |N| = 1 / (1 + v), so v = (1 - |N|) / |N|; a Blinn-Phong lobe of power p has variance 1 / p, the sum is that of the power
// p' = |N| p / (|N| + p (1 - |N|)). GGX has alpha^2 = 2 / (p + 2) (Walter et al. 2007), with x = 1 / p: alpha^2 = 2 x / (1 + 2 x).
#define SMOOTH_NORMAL
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "bump.glsl"

vec3 shade(Surface s) {
  vec3 normal = s.normal;
  float roughness = s.perceptual_roughness;
  if (bump_present) {
    vec3 mean = texture(bump_normals, s.normal_uv).xyz;
    float size = max(length(mean), 1e-3), squared = s.alpha * s.alpha;
    float x = 0.5 * squared / max(1.0 - squared, 1e-3) + max(1.0 - size, 0.0) / size;
    roughness = pow(2.0 * x / (1.0 + 2.0 * x), 0.25);
    normal = towards_viewer(bumped_normal(mean, frame_of_fragment()), s.view);
  }
  return lit_surface(s, normal, roughness, prefiltered_ggx(reflect(-s.view, normal), roughness));
}

#include "forward.glsl"
