// Diffuse base and glossy coat, mixed by the Fresnel term of the view (docs/reflection.md): F is taken out of both
// integrals, at the angle of view. The coat is a mirror where the surface is smooth, else Phong's lobe.
#include "surface.glsl"
#include "environment.glsl"
#include "split_sum.glsl"
#include "power_lobe.glsl"
uniform bool fresnel_exact;   // else Schlick's

float fresnel_dielectric(float cosine, float f0) {
  float root = sqrt(f0), eta = (1.0 + root) / max(1.0 - root, 1e-4);
  float inside = sqrt(max(0.0, 1.0 - (1.0 - cosine * cosine) / (eta * eta)));
  float across = (eta * inside - cosine) / (eta * inside + cosine);
  float along = (eta * cosine - inside) / (eta * cosine + inside);
  return 0.5 * (across * across + along * along);
}

vec3 shade(Surface s) {
  float cos_view = clamp(dot(s.normal, s.view), 0.0, 1.0), schlick = pow(1.0 - cos_view, 5.0);
  bool coated = s.coat.x > 0.0;
  float f = coated && fresnel_exact ? fresnel_dielectric(cos_view, s.coat.x) : mix(s.coat.x, s.coat.y, schlick);
  vec3 fresnel = coated && fresnel_exact ? vec3(f) : mix(s.f0, s.f90, schlick);
  vec3 coat;
  if (s.perceptual_roughness < 1e-3) {
    coat = environment_radiance(reflect(-s.view, s.normal));
  } else {
    PowerLobe lobe = power_lobe_of_width(s);
    coat = power_radiance(lobe.direction, lobe.spread);
  }
  return fresnel * coat + (1.0 - f) * s.diffuse / PI * irradiance(s.normal);
}

#include "forward.glsl"
