// Reflected light of an environment by Monte Carlo, a few samples a frame, added to those of the frames before. Before this text
// comes that of sampling_table_glsl (welkin/envmap/importance/sampling_table.h), one of three tables and two densities.
#include "sample_numbers.glsl"
#include "scatter_layers.glsl"

#ifndef WELKIN_TABLE
struct WelkinSample {
  vec3 direction;
  float pdf;
  ivec2 texel;
};
ivec2 welkin_texel(vec3 direction, ivec2 size);
WelkinSample welkin_sample(sampler2D environment, sampler2D table, vec2 u);
float welkin_pdf(sampler2D environment, sampler2D table, vec3 direction);
#endif

const int SAMPLING_BRDF = 0, SAMPLING_ENVIRONMENT = 1, SAMPLING_MIS = 2;
uniform int sampling;
uniform int samples;             // of this frame
uniform int samples_before, seed;
uniform mat3 world_to_environment;
uniform sampler2D equirect_map;  // radiance; every texel is a patch of its own
uniform sampler2D table_map;
uniform sampler2D sum_before;    // radiance of all samples of the frames before
layout(location = 0) out vec4 radiance_sum;  // alpha 1: a surface

vec3 radiance_of(vec3 direction) {
  return texelFetch(equirect_map, welkin_texel(direction, textureSize(equirect_map, 0)), 0).rgb;
}

float power_weight(float chosen, float other) {  // Veach & Guibas 1995, exponent 2
  float ratio = other / chosen;
  return 1.0 / (1.0 + ratio * ratio);
}

// `to_map` takes local directions to the map's.
vec3 by_brdf(Layers m, mat3 to_map, vec2 u, float lobe) {
  vec3 light = sample_layers(m, u, lobe);
  if (light.z <= 0.0) return vec3(0.0);
  vec4 value = layers_value(m, light);
  if (value.a <= 0.0) return vec3(0.0);
  vec3 direction = to_map * light;
  float weight = sampling == SAMPLING_MIS ? power_weight(value.a, welkin_pdf(equirect_map, table_map, direction)) : 1.0;
  return weight / value.a * value.rgb * radiance_of(direction);
}

vec3 by_environment(Layers m, mat3 to_map, vec2 u) {
  WelkinSample found = welkin_sample(equirect_map, table_map, u);
  vec3 light = found.direction * to_map;  // the matrix turned over: its inverse
  if (found.pdf <= 0.0 || light.z <= 0.0) return vec3(0.0);
  vec4 value = layers_value(m, light);
  float weight = sampling == SAMPLING_MIS ? power_weight(found.pdf, value.a) : 1.0;
  return weight / found.pdf * value.rgb * texelFetch(equirect_map, found.texel, 0).rgb;
}

vec3 reflected_light(Surface s) {
  if (material_kind == KIND_METAL && s.perceptual_roughness == 0.0) {  // a mirror
    vec3 colour = mix(s.f0, s.f90, schlick_weight(dot(s.normal, s.view)));
    return float(samples) * colour * radiance_of(world_to_environment * reflect(-s.view, s.normal));
  }
  mat3 frame = frame_about(s.normal), to_map = world_to_environment * frame;
  Layers m = layers_of(s, s.view * frame);
  uint stream = mixed_bits(pixel_seed(ivec2(gl_FragCoord.xy)) + uint(seed));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < samples; ++i) {
    uint index = uint(samples_before + i);
    if (sampling != SAMPLING_ENVIRONMENT)
      sum += by_brdf(m, to_map, sample_pair(index, stream), sample_number(index, stream ^ 0x9e3779b9u));
    if (sampling != SAMPLING_BRDF) sum += by_environment(m, to_map, sample_pair(index, stream ^ 0x85ebca6bu));
  }
  return sum;
}

void main() {
  Surface s = surface_of_fragment();
  vec3 before = samples_before > 0 ? texelFetch(sum_before, ivec2(gl_FragCoord.xy), 0).rgb : vec3(0.0);
  radiance_sum = vec4(before + reflected_light(s) + float(samples) * s.emission, 1.0);
}
