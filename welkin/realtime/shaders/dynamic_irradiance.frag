// King 2005: one look-up by the normal in the irradiance map of this frame, or by the mirrored view in its specular one (PHONG). Coefficients of few degrees ring:
// what falls below 0 is cut.
#include "surface.glsl"
uniform samplerCube lobe_map;  // E, or radiance filtered by the normalised lobe cos^N

vec3 shade(Surface s) {
#ifdef PHONG
  vec3 filtered = max(textureLod(lobe_map, reflect(-s.view, s.normal), 0.0).rgb, 0.0);
  // (N + 2) / (2 pi) cos^N times the cosine to the normal: the lobe's mean direction is (N + 1) / (N + 2) of its axis.
  return s.f0 * max(dot(s.normal, s.view), 0.0) * filtered;
#else
  return s.diffuse / PI * max(textureLod(lobe_map, s.normal, 0.0).rgb, 0.0);
#endif
}

#include "forward.glsl"
