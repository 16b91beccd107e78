// What a fragment is made of: the material's uniforms and textures, read as welkin/pathtrace reads them
// (image_based.h: every model becomes a diffuse base under a coat, or a metal).
#include "constants.glsl"

in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec4 texcoords;

uniform vec3 eye_position;
uniform vec3 view_direction;   // into the scene; orthographic cameras
uniform bool orthographic;

const int KIND_COATED = 0, KIND_METAL = 1, KIND_DIFFUSE = 2;
uniform int material_kind;
uniform vec3 material_base_color, material_f0, material_f90, material_emission;
uniform vec2 material_coat;         // F0 and F90 of the dielectric part
uniform float material_metallic, material_roughness;  // perceptual
uniform float material_exponent;    // Phong, Lafortune
uniform vec3 material_lafortune;    // Cx, Cy, Cz
uniform float material_normal_scale;
uniform bool material_compensated, material_double_sided;
uniform float material_alpha, material_alpha_cutoff;  // cutoff < 0: opaque
uniform int material_maps;          // bits: 1 base colour, 2 metallic, 4 roughness, 8 normal, 16 emission
uniform vec3 material_uv[10];       // two rows a map
uniform ivec4 material_texcoord;    // set of the first four maps
uniform int material_emission_texcoord, material_metallic_channel, material_roughness_channel;
uniform sampler2D base_color_map, metallic_map, roughness_map, normal_map, emission_map;

struct Surface {
  vec3 position, view;       // world; view: unit, towards the eye
  vec3 normal, geometric_normal, tangent, bitangent;  // unit; the shading normal faces the viewer
  vec2 normal_uv;            // where the normal map is looked up
  vec3 base_color;
  float metallic;            // of KIND_COATED
  vec3 diffuse;              // albedo of the diffuse part, before what the coat reflects is taken off
  vec3 f0, f90;              // of the glossy part
  vec2 coat;                 // F0 and F90 over the diffuse part
  float perceptual_roughness, alpha;
  vec3 emission;
};

vec2 map_uv(int map, int set) {
  vec3 uv = vec3(set == 0 ? texcoords.xy : texcoords.zw, 1.0);
  return vec2(dot(material_uv[2 * map], uv), dot(material_uv[2 * map + 1], uv));
}

float channel_of(vec4 texel, int channel) {
  return channel == 0 ? texel.r : channel == 1 ? texel.g : channel == 2 ? texel.b : texel.a;
}

// Turned towards the viewer until it faces it by a cosine of 0.01, as the path tracer does.
vec3 towards_viewer(vec3 normal, vec3 view) {
  float cosine = dot(normal, view);
  return cosine >= 0.01 ? normal : normalize(normal + (0.01 - cosine) * view);
}

vec3 view_of_fragment() { return orthographic ? -view_direction : normalize(eye_position - world_position); }

// Of the triangle, on the viewer's side.
vec3 geometric_normal_of_fragment(vec3 view) {
  vec3 normal = normalize(cross(dFdx(world_position), dFdy(world_position)));
  return dot(normal, view) < 0.0 ? -normal : normal;
}

// The frame of the fragment without its normal map: tangent, bitangent (of the map's handedness) and normal, unit, the normal
// on the side of the viewer where the triangle is seen from.
mat3 frame_of_fragment() {
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 normal = normalize(world_normal);
  // A mesh's normals may contradict its winding, which says what is in front.
  if (side * dot(normal, geometric_normal_of_fragment(view_of_fragment())) < 0.0) normal = -normal;
  vec3 across = world_tangent.xyz - dot(world_tangent.xyz, normal) * normal;
  float squared = dot(across, across);
  vec3 tangent = squared > 1e-12 ? across * inversesqrt(squared)
                                 : normalize(abs(normal.y) < 0.9 ? cross(vec3(0, 1, 0), normal) : cross(vec3(1, 0, 0), normal));
  return mat3(tangent, world_tangent.w * cross(normal, tangent), side * normal);
}

vec3 normal_of_texel(vec3 texel, mat3 frame) {
  vec2 slope = material_normal_scale * (2.0 * texel.xy - 1.0);
  float side = gl_FrontFacing ? 1.0 : -1.0;
  vec3 normal = side * slope.x * frame[0] + side * slope.y * frame[1] + (2.0 * texel.z - 1.0) * frame[2];
  return dot(normal, normal) > 1e-12 ? normalize(normal) : frame[2];
}

Surface surface_of_fragment() {
  Surface s;
  s.position = world_position;
  s.view = view_of_fragment();
  mat3 frame = frame_of_fragment();
  s.geometric_normal = geometric_normal_of_fragment(s.view);
  s.normal_uv = map_uv(3, material_texcoord.w);
#ifdef SMOOTH_NORMAL  // the technique reads the normal map itself
  s.normal = frame[2];
#else
  s.normal = (material_maps & 8) != 0 ? normal_of_texel(texture(normal_map, s.normal_uv).xyz, frame) : frame[2];
#endif
  s.normal = towards_viewer(s.normal, s.view);
  s.tangent = normalize(frame[0] - dot(frame[0], s.normal) * s.normal);
  s.bitangent = cross(s.normal, s.tangent);

  vec4 base = vec4(material_base_color, material_alpha);
  float metallic = material_metallic, roughness = material_roughness;
  if ((material_maps & 1) != 0) base *= texture(base_color_map, map_uv(0, material_texcoord.x));
  if ((material_maps & 2) != 0)
    metallic *= channel_of(texture(metallic_map, map_uv(1, material_texcoord.y)), material_metallic_channel);
  if ((material_maps & 4) != 0)
    roughness *= channel_of(texture(roughness_map, map_uv(2, material_texcoord.z)), material_roughness_channel);
  if (base.a < material_alpha_cutoff) discard;

  s.base_color = base.rgb;
  s.metallic = metallic;
  s.coat = material_kind == KIND_COATED ? material_coat : vec2(0.0);
  s.diffuse = material_kind == KIND_COATED ? (1.0 - metallic) * base.rgb : material_kind == KIND_DIFFUSE ? base.rgb : vec3(0.0);
  s.f0 = material_kind == KIND_COATED ? mix(vec3(s.coat.x), base.rgb, metallic) : base.rgb * material_f0;
  s.f90 = material_kind == KIND_COATED ? vec3(mix(s.coat.y, 1.0, metallic)) : material_f90;
  s.perceptual_roughness = clamp(roughness, 0.0, 1.0);
  s.alpha = s.perceptual_roughness * s.perceptual_roughness;
  s.emission = gl_FrontFacing || material_double_sided ? material_emission : vec3(0.0);
  if ((material_maps & 16) != 0) s.emission *= texture(emission_map, map_uv(4, material_emission_texcoord)).rgb;
  return s;
}
