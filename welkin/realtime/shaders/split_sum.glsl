// Split sum (Karis 2013) with the energy that single scattering loses given back (Turquin 2019), as image_based.h.
vec3 reflected_share(vec2 dfg, vec3 f0, vec3 f90, bool compensated) {
  vec3 single = f0 * dfg.x + f90 * dfg.y;
  return compensated ? single * (1.0 + f0 * (1.0 / max(dfg.x + dfg.y, 1e-4) - 1.0)) : single;
}

vec2 look_up_dfg(float cos_view, float perceptual_roughness) {
  if (perceptual_roughness < 1e-3) {  // Schlick itself
    float fresnel = pow(clamp(1.0 - cos_view, 0.0, 1.0), 5.0);
    return vec2(1.0 - fresnel, fresnel);
  }
  return textureLod(dfg_map, vec2(cos_view, perceptual_roughness), 0.0).rg;
}

// What of the light passes the coat and reaches the diffuse part.
float coat_transmission(Surface s, vec2 dfg) {
  return max(0.0, 1.0 - reflected_share(dfg, vec3(s.coat.x), vec3(s.coat.y), material_compensated).x);
}
