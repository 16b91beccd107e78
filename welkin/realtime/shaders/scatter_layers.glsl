// The path tracer's materials, to evaluate and to sample: facets (GGX, height-correlated Smith, Schlick's term), light between
// facets (Kulla & Conty 2017, after Turquin's and theirs the lobe that gives back what single scattering loses) and a diffuse
// base under them (Kelemen & Szirmay-Kalos 2001): line by line welkin/brdf/scatter/layers.h, microfacet.h and warps.h, isotropic.
// Directions are local: z is the shading normal.
#include "surface.glsl"

uniform sampler2D energy_map;          // (lost, bias): columns by energy_axis, rows by perceptual roughness
uniform sampler2D energy_average_map;  // (lost, bias, spread, log(1 + 1 / spread)) by perceptual roughness; nearest

struct Layers {
  vec3 view;
  float alpha, stretched;         // |(alpha x, alpha y, z)| of the view
  vec3 f0, f90;
  vec3 between;                   // what the light between facets reflects of a constant environment
  vec3 multiple;                  // of that lobe, without lost(light)
  float spread, log_spread;
  vec3 diffuse;                   // of the lobe without 1 - coat(light)
  vec3 coat;                      // constant, of lost, of bias
  float p_facets, p_multiple, p_diffuse;
};

float schlick_weight(float cosine) {
  float x = max(0.0, 1.0 - cosine), x2 = x * x;
  return x2 * x2 * x;
}

float largest_of(vec3 v) { return max(v.r, max(v.g, v.b)); }

vec2 energy_of(float cosine, float alpha) {
  float c = clamp(cosine, 0.0, 1.0), a = max(alpha, 1e-4);
  vec2 at = vec2((sqrt(c) + c * (1.0 + a) / (c + a)) / 2.0, sqrt(clamp(alpha, 0.0, 1.0)));
  vec2 size = vec2(textureSize(energy_map, 0));
  return textureLod(energy_map, (at * (size - 1.0) + 0.5) / size, 0.0).rg;
}

vec4 energy_average(float alpha) {
  int last = textureSize(energy_average_map, 0).x - 1;
  float at = sqrt(clamp(alpha, 0.0, 1.0)) * float(last);
  int i = min(int(at), last - 1);
  vec4 a = texelFetch(energy_average_map, ivec2(i, 0), 0), b = texelFetch(energy_average_map, ivec2(i + 1, 0), 0);
  return vec4(mix(a.rg, b.rg, at - float(i)), b.ba);
}

vec3 multiple_colour(vec3 fresnel, float average) { return fresnel * fresnel * average / (1.0 - fresnel * (1.0 - average)); }

vec3 average_schlick(vec3 f0, vec3 f90) { return f0 + (f90 - f0) / 21.0; }

float coat_energy(vec3 coat, vec2 energy) { return coat.x + coat.y * energy.x + coat.z * energy.y; }

// Of a coated surface: dielectric and metal are mixed, so that both being white is white.
vec3 multiple_of(Surface s, float average) {
  if (material_kind != KIND_COATED) return multiple_colour(average_schlick(s.f0, s.f90), average);
  vec3 dielectric = multiple_colour(average_schlick(vec3(s.coat.x), vec3(s.coat.y)), average);
  return mix(dielectric, multiple_colour(average_schlick(s.base_color, vec3(1.0)), average), s.metallic);
}

Layers layers_of(Surface s, vec3 view) {
  Layers m;
  m.view = view;
  m.alpha = clamp(s.alpha, 1e-3, 1.0);
  m.stretched = length(vec3(m.alpha * view.xy, view.z));
  m.f0 = s.f0;
  m.f90 = s.f90;
  vec2 energy = energy_of(view.z, m.alpha);
  vec4 average = energy_average(m.alpha);
  m.spread = average.b;
  m.log_spread = average.a;
  vec3 facets = (1.0 - energy.x - energy.y) * s.f0 + energy.y * s.f90, between = vec3(0.0), base = vec3(0.0);
  float k = 0.0;
  if (material_compensated && material_kind != KIND_DIFFUSE) {
    between = energy.x * multiple_of(s, 1.0 - average.r);
    k = multiple_colour(average_schlick(vec3(s.coat.x), vec3(s.coat.y)), 1.0 - average.r).r;
  }
  m.between = between;
  m.multiple = between / (PI * average.r);
  m.coat = vec3(s.coat.x, k - s.coat.x, s.coat.y - s.coat.x);
  float below = 1.0 - coat_energy(m.coat, average.rg);
  if (below > 0.0) base = max(0.0, 1.0 - coat_energy(m.coat, energy)) * s.diffuse;
  m.diffuse = below > 0.0 ? base / (PI * below) : vec3(0.0);
  vec3 shares = vec3(largest_of(facets), largest_of(between), largest_of(base));
  float sum = shares.x + shares.y + shares.z;
  shares = sum > 0.0 ? shares / sum : vec3(1.0, 0.0, 0.0);
  m.p_facets = shares.x;
  m.p_multiple = shares.y;
  m.p_diffuse = shares.z;
  return m;
}

// Of the facets alone, chosen always. rgb: f times the light's cosine; a: the density of sample_facets. light.z > 0.
vec4 facets_value(Layers m, vec3 light) {
  vec3 h = light + m.view;
  vec2 slope = h.xy / m.alpha;
  float squared = dot(h, h), ratio = squared / max(dot(slope, slope) + h.z * h.z, 1e-30);
  float distribution = ratio * ratio / (PI * m.alpha * m.alpha);
  float stretched_light = length(vec3(m.alpha * light.xy, light.z));
  float share = distribution * light.z / (2.0 * max(light.z * m.stretched + m.view.z * stretched_light, 1e-37));
  return vec4(share * mix(m.f0, m.f90, schlick_weight(min(1.0, sqrt(squared) / 2.0))),
              distribution / (2.0 * (m.view.z + m.stretched)));
}

// rgb: f times the light's cosine; a: the density of sample_layers, per steradian. light.z > 0.
vec4 layers_value(Layers m, vec3 light) {
  vec4 value = facets_value(m, light);
  value.a *= m.p_facets;
  vec2 energy = energy_of(light.z, m.alpha);
  value.rgb += energy.x * light.z * m.multiple + max(0.0, 1.0 - coat_energy(m.coat, energy)) * light.z * m.diffuse;
  value.a += m.p_multiple * light.z / (PI * (light.z * light.z + m.spread) * m.log_spread) + m.p_diffuse * light.z / PI;
  return value;
}

vec3 at_cosine(float cosine, float sine, float turns) {
  return vec3(sine * cos(2.0 * PI * turns), sine * sin(2.0 * PI * turns), cosine);
}

// The view mirrored at a visible normal (Heitz 2018, as a cap: Dupuy & Benyoub 2023). May lie below the horizon.
vec3 sample_facets(Layers m, vec2 u) {
  vec3 stretched = vec3(m.alpha * m.view.xy, m.view.z) / m.stretched;
  float w = u.x * (1.0 + stretched.z);
  vec3 cap = at_cosine(0.0, sqrt(max(0.0, w * (2.0 - w))), u.y);
  vec3 normal = vec3(m.alpha * (cap.xy + stretched.xy), (1.0 - u.x) * (1.0 + stretched.z));
  float squared = dot(normal, normal);
  return squared > 0.0 ? 2.0 * dot(m.view, normal) / squared * normal - m.view : vec3(0.0, 0.0, -1.0);
}

vec3 sample_layers(Layers m, vec2 u, float lobe) {
  if (lobe < m.p_facets) return sample_facets(m, u);
  if (lobe < m.p_facets + m.p_multiple) {
    float x = (1.0 - u.x) * m.log_spread;
    float grown = x < 1e-3 ? x * (1.0 + x / 2.0) : exp(x) - 1.0;  // expm1
    float squared = min(1.0, m.spread * grown);
    return at_cosine(sqrt(squared), sqrt(1.0 - squared), u.y);
  }
  return at_cosine(sqrt(1.0 - u.x), sqrt(u.x), u.y);
}

// A right-handed frame about the unit vector z (Duff et al. 2017).
mat3 frame_about(vec3 z) {
  float side = z.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (side + z.z), b = z.x * z.y * a;
  return mat3(vec3(1.0 + side * z.x * z.x * a, side * b, -side * z.x), vec3(b, side + z.y * z.y * a, -z.y), z);
}
