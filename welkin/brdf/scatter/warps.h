#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include <welkin/geometry/frame.h>
#include <welkin/geometry/vec3f.h>

// From the unit square to directions, each with its density per steradian. Private to welkin/brdf/scatter.

namespace welkin::scatter_detail {

inline constexpr float pi = std::numbers::pi_v<float>;

/// (cos, sin) of 2 pi u, u in [0, 1], to 1e-7: Taylor's series about the nearest quarter turn.
inline Vec2f turn(float u) {
  const int q = static_cast<int>(4 * u + 0.5f);
  const float x = 2 * pi * (u - 0.25f * static_cast<float>(q)), x2 = x * x;
  const float sine = x * (1 + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 / 362880))));
  const float cosine = 1 + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 / 40320)));
  const Vec2f straight{(q & 1) != 0 ? -sine : cosine, (q & 1) != 0 ? cosine : sine};
  return (q & 2) != 0 ? -1.0f * straight : straight;
}

/// A direction at this cosine from z, at azimuth 2 pi u.
inline Vec3f at_cosine(float cosine, float sine, float u) {
  const Vec2f t = turn(u);
  return {sine * t.x, sine * t.y, cosine};
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

/// Density c / (pi (c^2 + s) log(1 + 1 / s)), c = cos: the cosine lobe for a large s, uniform in log c down to sqrt(s) for
/// a small one. Made for (1 - E(c)) c, which has that shape (energy_table.h).
struct LostDensity {
  float spread = 1, log_spread = 0.69314718f;  ///< s and log(1 + 1 / s)
};

inline Vec3f sample_lost(LostDensity d, Vec2f u) {
  const float c2 = std::min(1.0f, d.spread * std::expm1((1 - u.x) * d.log_spread));
  return at_cosine(std::sqrt(c2), std::sqrt(1 - c2), u.y);
}

inline float lost_pdf(LostDensity d, float cosine) {
  return cosine / (pi * (cosine * cosine + d.spread) * d.log_spread);
}

}  // namespace welkin::scatter_detail
