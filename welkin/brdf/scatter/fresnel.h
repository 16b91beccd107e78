#pragma once
#include <algorithm>
#include <cmath>

#include <welkin/image/rgb.h>

// Fresnel terms in single precision, for scatter.cpp. `cosine` is that between the direction and the facet's normal, in
// [0, 1]. The closed forms in double are in welkin/brdf/ggx.h.

namespace welkin::scatter_detail {

/// (1 - cosine)^5, Schlick's weight of grazing reflection.
inline float schlick_weight(float cosine) {
  const float x = std::max(0.0f, 1 - cosine), x2 = x * x;
  return x2 * x2 * x;
}

/// Unpolarised reflectance of a smooth dielectric of index eta; 1 at total reflection (eta < 1).
inline float fresnel_dielectric(float cosine, float eta) {
  const float cos2_refracted = 1 - std::max(0.0f, (1 - cosine) * (1 + cosine)) / (eta * eta);
  if (cos2_refracted <= 0) return 1;
  const float refracted = std::sqrt(cos2_refracted);
  const float perpendicular = (cosine - eta * refracted) / (cosine + eta * refracted);
  const float parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
  return (perpendicular * perpendicular + parallel * parallel) / 2;
}

/// Of a smooth conductor of index eta + i k (Born & Wolf, section 14.2): a^2 + b^2 is the modulus of
/// (eta + i k)^2 - sin^2.
inline float fresnel_conductor(float cosine, float eta, float k) {
  const float cos2 = std::min(1.0f, cosine * cosine), sin2 = 1 - cos2;
  const float real = (eta - k) * (eta + k) - sin2, cross = 2 * eta * k;
  const float modulus = std::sqrt(real * real + cross * cross);
  // a^2 = (modulus + real) / 2; where real < 0 the sum cancels, and cross^2 / (2 (modulus - real)) is the same.
  const float a2 = real > 0 ? (modulus + real) / 2 : cross * cross / (2 * (modulus - real) + 1e-30f);
  const float middle = 2 * std::sqrt(a2) * cosine;
  const float perpendicular = (modulus + cos2 - middle) / (modulus + cos2 + middle);
  const float far = cos2 * modulus + sin2 * sin2, near = middle * sin2;
  return std::min(1.0f, perpendicular * (1 + (far - near) / (far + near)) / 2);
}

inline Rgb fresnel_conductor(float cosine, Rgb eta, Rgb k) {
  return {fresnel_conductor(cosine, eta.r, k.r), fresnel_conductor(cosine, eta.g, k.g),
          fresnel_conductor(cosine, eta.b, k.b)};
}

/// 2 * integral of F(c) c dc, what a conductor reflects of light from everywhere, by two nodes whose places and weights
/// are fitted to eleven materials from silver to glass, each within 0.002.
inline Rgb average_fresnel_conductor(Rgb eta, Rgb k) {
  return 0.21f * fresnel_conductor(0.25f, eta, k) + 0.79f * fresnel_conductor(0.76f, eta, k);
}

}  // namespace welkin::scatter_detail
