// Lobes cos^N about any axis from one chain of maps (techniques/power_lobe_maps.h has the level law and the table).
const int POWER_NONE = 0, POWER_PHONG = 1, POWER_LAFORTUNE = 2;
uniform int material_power;             // whether the material is a power of a cosine itself
uniform samplerCube power_map;          // level k: the environment under cos^N, N = power_largest_exponent / 4^k; at the last 0
uniform sampler2D power_moments;        // (energy, lean, 1 - mean cosine) at (n.axis, -1 to 1 from the first column to the last; four rows a level)
uniform float power_last_level, power_largest_exponent;
uniform bool power_published;           // one look-up about the axis itself, n.axis outside

// spread = 1 / (N + 2), the mean of 1 - cos under cos^N, in (0, 1/2]; it is linear between two levels.
float power_level(float spread) {
  if (spread >= 1.0 / 3.0) return min(power_last_level, power_last_level - 1.0 + 6.0 * (spread - 1.0 / 3.0));
  float k = clamp(floor(0.5 * log2(power_largest_exponent / (1.0 / spread - 2.0))), 0.0, power_last_level - 2.0);
  float exponent = power_largest_exponent * exp2(-2.0 * k);
  float from = 1.0 / (exponent + 2.0), to = 1.0 / (0.25 * exponent + 2.0);
  return max(0.0, k + (spread - from) / (to - from));
}

vec3 power_radiance(vec3 direction, float spread) {
  vec3 filtered = textureLod(power_map, in_map(direction), power_level(spread)).rgb;
  float sharpest = 1.0 / (power_largest_exponent + 2.0);
  return spread < sharpest ? mix(environment_radiance(direction), filtered, spread / sharpest) : filtered;
}

struct PowerLobe {
  vec3 direction;
  float spread;   // of the look-up
  float energy;   // what the lobe (N + 1) / (2 pi) cos^N times n.l reflects of a constant environment
};

// The lobe about `axis` (unit) as a surface of normal n sees it.
PowerLobe power_lobe(vec3 n, vec3 axis, float exponent) {
  float n_r = clamp(dot(n, axis), -1.0, 1.0), spread = 1.0 / (exponent + 2.0);
  if (power_published) return PowerLobe(axis, spread, max(0.0, n_r));
  float rows = 4.0 * power_last_level + 1.0;
  float columns = float(textureSize(power_moments, 0).x);
  vec2 at = vec2((0.5 + (0.5 + 0.5 * n_r) * (columns - 1.0)) / columns, (4.0 * power_level(spread) + 0.5) / rows);
  vec3 moments = textureLod(power_moments, at, 0.0).rgb;
  return PowerLobe(axis + moments.g * (n - n_r * axis), moments.b, moments.r);
}

// Phong's and Lafortune's materials: colour (N + 2) / (2 pi) |axis|^N times the lobe; what a compensated one loses comes
// back as diffuse light.
vec3 power_material(Surface s, vec3 axis) {
  float size = length(axis), exponent = material_exponent;
  PowerLobe lobe = power_lobe(s.normal, axis / max(size, 1e-6), exponent);
  float share = (exponent + 2.0) / (exponent + 1.0) * pow(max(size, 1e-6), exponent) * lobe.energy;
  vec3 glossy = share * power_radiance(lobe.direction, lobe.spread);
  if (material_compensated) glossy += max(0.0, 1.0 - share) / PI * irradiance(s.normal);
  return s.f0 * glossy;
}

// GGX of width alpha by the cosine's power of the same width about the mirrored view: N = (1 / alpha^2 - 1) / 2.
PowerLobe power_lobe_of_width(Surface s) {
  float squared = max(s.alpha * s.alpha, 1e-6);
  return power_lobe(s.normal, reflect(-s.view, s.normal), 0.5 * (1.0 / squared - 1.0));
}

// Materials of another kind: lobe and level of cos^N, energy of the DFG table, and the diffuse part.
vec3 power_shade_other(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0);
  vec2 dfg = look_up_dfg(cos_view, s.perceptual_roughness);
  PowerLobe lobe = power_lobe_of_width(s);
  return reflected_share(dfg, s.f0, s.f90, material_compensated) * power_radiance(lobe.direction, lobe.spread) +
         coat_transmission(s, dfg) * s.diffuse / PI * irradiance(s.normal);
}
