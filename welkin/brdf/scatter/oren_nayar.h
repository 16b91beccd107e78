#pragma once
#include <algorithm>
#include <cmath>

#include <welkin/brdf/scatter/scatter.h>
#include <welkin/brdf/scatter/warps.h>

// Rough diffuse facets, energy-preserving (Portsmouth, Kutz & Hill 2024, "EON"): with s = l.v - l.z v.z and t =
// max(l.z, v.z) where s > 0, else 1,
//   single = A (1 + r s / t),   A = 1 / (1 + (1/2 - 2 / (3 pi)) r)
// (Fujii's form) has the directional albedo A (1 + r G(v) / pi); a reciprocal lobe gives back what it loses, coloured by
// as many reflections. Oren & Nayar's formula (1994) is A' (1 + B' / A' s / t) where s > 0: r = B' / A' is the same shape.
// r is at most 0.78, at sigma = pi / 2.

namespace welkin::scatter_detail {

inline constexpr float eon_a = 0.28779340f;  // 1/2 - 2 / (3 pi)
inline constexpr float eon_b = 0.07248821f;  // 2/3 - 28 / (15 pi): E_avg = A (1 + eon_b r)

inline float eon_roughness(float sigma) {
  const float s2 = sigma * sigma;
  return 0.45f * s2 / (s2 + 0.09f) / (1 - 0.5f * s2 / (s2 + 0.33f));
}

/// (1 - E(c)) / (A r) = eon_a - G / pi, with G as in the paper; (1 - sin^3) / cos = cos (1 + sin + sin^2) / (1 + sin).
inline float eon_lost(float cosine) {
  const float c = std::min(1.0f, cosine), s = std::sqrt((1 - c) * (1 + c));
  const float g = s * (std::acos(c) - s * c) + (2.0f / 3) * (s * c * (1 + s + s * s) / (1 + s) - s);
  return std::max(0.0f, eon_a - g / pi);
}

struct OrenNayar {
  Vec3f view;
  float r = 0, a = 1;   ///< a: A
  float lost_view = 0;  ///< eon_lost
  float p_uniform = 0;  ///< single grows like 1 / cos where light and view are both grazing
  Rgb multiple;         ///< of eon_lost(l) eon_lost(v) / pi
};

inline float eon_multiple(float albedo, float average) {
  return albedo * albedo * average / (1 - albedo * (1 - average));
}

inline OrenNayar make_oren_nayar(const Scatter& s, Vec3f view) {
  OrenNayar lobe;
  lobe.view = view;
  lobe.r = eon_roughness(s.sigma_radians);
  lobe.a = 1 / (1 + eon_a * lobe.r);
  lobe.lost_view = eon_lost(view.z);
  const float average = lobe.a * (1 + eon_b * lobe.r), x = 1 - view.z;
  lobe.p_uniform = 0.7f * lobe.r * x * x;
  const float scale = lobe.a * lobe.r / (eon_a - eon_b);  // (A r)^2 / (1 - E_avg)
  lobe.multiple = scale * Rgb{eon_multiple(s.color.r, average), eon_multiple(s.color.g, average),
                              eon_multiple(s.color.b, average)};
  return lobe;
}

inline ScatterValue oren_nayar_value(const OrenNayar& lobe, Rgb color, Vec3f light) {
  const float s = dot(light, lobe.view) - light.z * lobe.view.z;
  const float t = s > 0 ? std::max(light.z, lobe.view.z) : 1;
  const float single = lobe.a * (1 + lobe.r * std::max(-1.0f, s / t));
  const float multiple = eon_lost(light.z) * lobe.lost_view, share = light.z / pi;
  return {share * (single * color + multiple * lobe.multiple),
          share * (1 - lobe.p_uniform) + lobe.p_uniform / (2 * pi)};
}

inline Rgb oren_nayar_albedo(const OrenNayar& lobe, Rgb color) {
  // The multiple lobe integrates to eon_lost(v) (eon_a - eon_b) times its colour.
  return (1 - lobe.a * lobe.r * lobe.lost_view) * color + (lobe.lost_view * (eon_a - eon_b)) * lobe.multiple;
}

}  // namespace welkin::scatter_detail
