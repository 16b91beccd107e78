// Normal mapping as it is commonly done: the mip-mapped normal, made of unit length again, and the surface's own lobe. The bumps that
// were averaged away are gone; without mips they alias.
#define SMOOTH_NORMAL
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "bump.glsl"

uniform bool mips;

vec3 shade(Surface s) {
  vec3 normal = s.normal;
  if (bump_present) {
    vec4 texel = mips ? texture(normal_map, s.normal_uv) : textureLod(normal_map, s.normal_uv, 0.0);
    normal = towards_viewer(normal_of_texel(texel.xyz, frame_of_fragment()), s.view);
  }
  return lit_surface(s, normal, s.perceptual_roughness, prefiltered_ggx(reflect(-s.view, normal), s.perceptual_roughness));
}

#include "forward.glsl"
