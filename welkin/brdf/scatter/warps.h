#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/geometry/frame.h>
#include <welkin/geometry/vec3f.h>

// From the unit square to directions, each with its density per steradian. Private to welkin/brdf/scatter.

namespace welkin::scatter_detail {

inline constexpr float pi = std::numbers::pi_v<float>;

/// A direction at this cosine from z, at azimuth 2 pi u.
inline Vec3f at_cosine(float cosine, float sine, float u) {
  const float phi = 2 * pi * u;
  return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// Density cos / pi over the hemisphere; z > 0 for u < 1.
inline Vec3f sample_cosine(Vec2f u) { return at_cosine(std::sqrt(1 - u.x), std::sqrt(u.x), u.y); }

/// Density 1 / (2 pi) over the hemisphere.
inline Vec3f sample_uniform(Vec2f u) { return at_cosine(1 - u.x, std::sqrt(u.x * (2 - u.x)), u.y); }

/// Density (N + 1) / (2 pi) cos^N about the unit vector `axis`. With c = (1 - u)^(1 / (N + 1)), 1 - c is made by expm1:
/// for large N it would be rounding error otherwise.
inline Vec3f sample_cosine_power(Vec3f axis, float exponent, Vec2f u) {
  const float missing = -std::expm1(std::log1p(-u.x) / (exponent + 1));  // 1 - c
  const Vec3f local = at_cosine(1 - missing, std::sqrt(std::max(0.0f, missing * (2 - missing))), u.y);
  return make_frame(axis).to_world(local);
}

/// Density c / (pi (c^2 + spread) log(1 + 1 / spread)), c = cos: the cosine lobe for a large spread, uniform in log c
/// down to sqrt(spread) for a small one. Made for (1 - E(c)) c, which has that shape (energy_table.h).
inline Vec3f sample_lost(float spread, Vec2f u) {
  const float c2 = std::min(1.0f, spread * std::expm1((1 - u.x) * std::log1p(1 / spread)));
  return at_cosine(std::sqrt(c2), std::sqrt(1 - c2), u.y);
}

inline float lost_pdf(float spread, float cosine) {
  return cosine / (pi * (cosine * cosine + spread) * std::log1p(1 / spread));
}

}  // namespace welkin::scatter_detail
