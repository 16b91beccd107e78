// Krivanek & Colbert 2008 ("Real-time shading with filtered importance sampling"): few directions of the facets' density, each
// looked up in the box mip whose texels are as large as the direction's share of the sphere,
//   level = 1/2 log2(1 / (N pdf)  /  solid angle of a texel there) + bias,
// so that there is blur instead of noise. The diffuse part and the light between facets are look-ups, as in prefiltered_ggx.frag.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "sample_numbers.glsl"
#include "scatter_layers.glsl"

uniform int samples;
uniform float level_bias;
uniform bool same_for_all;  // pixels: no noise, but bands where there are too few

// Of an edge-N cube's texel: 4 / N^2 (1 + s^2 + t^2)^(-3/2), and the root is 1 over the unit direction's largest component.
float texel_steradians(vec3 direction, float size) {
  vec3 a = abs(direction);
  float largest = max(a.x, max(a.y, a.z));
  return 4.0 / (size * size) * largest * largest * largest;
}

// Hammersley's points, turned about for each pixel (Cranley & Patterson 1976) or not.
vec2 direction_numbers(int i, vec2 turn) {
  return fract(vec2((float(i) + 0.5) / float(samples), unit_number(reversed_bits(uint(i))) + 0.5 / float(samples)) + turn);
}

vec3 facets_light(Layers m, mat3 to_map, vec2 turn) {
  float size = float(textureSize(environment_map, 0).x);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < samples; ++i) {
    vec3 light = sample_facets(m, direction_numbers(i, turn));
    if (light.z <= 0.0) continue;
    vec4 value = facets_value(m, light);  // a: the density
    vec3 direction = to_map * light;
    float level = 0.5 * log2(1.0 / (float(samples) * value.a * texel_steradians(direction, size))) + level_bias;
    sum += value.rgb / value.a * textureLod(environment_map, direction, clamp(level, 0.0, environment_last_level)).rgb;
  }
  return sum / float(samples);
}

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  if (material_kind == KIND_METAL && s.perceptual_roughness == 0.0)
    return mix(s.f0, s.f90, schlick_weight(cos_view)) * environment_radiance(reflect(-s.view, s.normal));
  vec2 dfg = look_up_dfg(cos_view, s.perceptual_roughness);
  vec3 below = coat_transmission(s, dfg) * s.diffuse / PI * irradiance(s.normal);
  if (material_kind == KIND_DIFFUSE) return below;
  mat3 frame = frame_about(s.normal);
  Layers m = layers_of(s, s.view * frame);
  uint seed = pixel_seed(ivec2(gl_FragCoord.xy));
  vec2 turn = same_for_all ? vec2(0.0) : vec2(unit_number(seed), unit_number(mixed_bits(seed)));
  // Light between facets comes from everywhere, as if from a diffuse surface that reflects as much of it.
  vec3 between = m.between / PI * irradiance(s.normal);
  return facets_light(m, world_to_environment * frame, turn) + between + below;
}

#include "forward.glsl"
