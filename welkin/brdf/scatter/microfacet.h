#pragma once
#include <algorithm>
#include <cmath>

#include <welkin/brdf/scatter/warps.h>
#include <welkin/geometry/vec3f.h>

// GGX with the widths alpha_x, alpha_y (Walter et al. 2007; Heitz 2014), single precision. With the stretched vector's
// length S(w) = |(alpha_x x, alpha_y y, z)|, Smith's term is 1 + 2 Lambda(w) = S(w) / w.z, hence for height-correlated
// masking and shadowing
//   V = G2 / (4 l.z v.z) = 1 / (2 (l.z S(v) + v.z S(l))),
// and the density of mirrored visible normals is G1(v) D / (4 v.z) = D / (2 (v.z + S(v))): nothing is divided by a
// cosine that may be 0.

namespace welkin::scatter_detail {

struct MicrofacetView {
  Vec3f view;
  float alpha_x = 1, alpha_y = 1;
  float stretched = 1;  ///< S(view)
};

inline float stretched_length(Vec3f w, float alpha_x, float alpha_y) {
  const float x = alpha_x * w.x, y = alpha_y * w.y;
  return std::sqrt(x * x + y * y + w.z * w.z);
}

inline MicrofacetView microfacet_view(Vec3f view, float alpha_x, float alpha_y) {
  const float x = std::max(alpha_x, 1e-3f), y = std::max(alpha_y, 1e-3f);
  return {view, x, y, stretched_length(view, x, y)};
}

struct Facet {
  float distribution = 0;  ///< D
  float cosine = 0;        ///< view . half
};

/// D by the components of the half vector h = l + v, not normalised: near the mirror direction nothing cancels but x and y
/// themselves, whose rounding is 6e-8 / alpha of the width.
inline Facet facet_of(const MicrofacetView& v, Vec3f light) {
  const Vec3f h = light + v.view;
  const float x = h.x / v.alpha_x, y = h.y / v.alpha_y;
  const float squared = dot(h, h), q = std::max(x * x + y * y + h.z * h.z, 1e-30f);
  const float ratio = squared / q;
  return {ratio * ratio / (pi * v.alpha_x * v.alpha_y), std::min(1.0f, std::sqrt(squared) / 2)};
}

/// D V cos_light.
inline float reflected_share(const MicrofacetView& v, Vec3f light, float distribution) {
  const float s_light = stretched_length(light, v.alpha_x, v.alpha_y);
  return distribution * light.z / (2 * std::max(light.z * v.stretched + v.view.z * s_light, 1e-37f));
}

inline float microfacet_pdf(const MicrofacetView& v, float distribution) {
  return distribution / (2 * (v.view.z + v.stretched));
}

/// The view mirrored at a visible normal. In the stretched space normals are those of a sphere, and the mirrored view is
/// uniform over the cap above height -v.z (Dupuy & Benyoub 2023): with w = u (1 + v.z) the cap's point has z = 1 - w.
/// The light may lie below the horizon.
inline Vec3f sample_microfacet(const MicrofacetView& v, Vec2f u) {
  const float inverse = 1 / v.stretched;
  const Vec3f stretched{inverse * v.alpha_x * v.view.x, inverse * v.alpha_y * v.view.y, inverse * v.view.z};
  const float w = u.x * (1 + stretched.z);
  const Vec3f cap = at_cosine(0, std::sqrt(std::max(0.0f, w * (2 - w))), u.y);
  const float z = (1 - u.x) * (1 + stretched.z);  // 1 - w + v.z
  const Vec3f normal{v.alpha_x * (cap.x + stretched.x), v.alpha_y * (cap.y + stretched.y), z};
  const float squared = dot(normal, normal);
  if (!(squared > 0)) return {};
  return (2 * dot(v.view, normal) / squared) * normal - v.view;
}

}  // namespace welkin::scatter_detail
