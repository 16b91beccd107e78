#pragma once
#include <algorithm>
#include <cmath>

#include <welkin/brdf/scatter/energy_table.h>
#include <welkin/brdf/scatter/scatter.h>
#include <welkin/brdf/scatter/warps.h>

// Phong, Blinn-Phong and Lafortune: a power of a cosine, about the mirrored view, about the normal for the half vector, or
// about (Cx v.x, Cy v.y, Cz v.z). Powers are exp(N log1p(cos - 1)) with 1 - cos by differences, because N goes up to
// 1e5. Sampled by the power, mixed with a cosine lobe where the exponent is low.

namespace welkin::scatter_detail {

struct PowerLobe {
  Vec3f view;
  Vec3f axis{0, 0, 1};  ///< of the power; unit
  bool half = false;    ///< the power is of the half vector
  float exponent = 0;
  float peak = 0;  ///< the BRDF on the axis, for color 1
  float p_lobe = 1, p_cosine = 0, p_lost = 0;
  const EnergyTable* table = nullptr;  ///< null: not compensated
  float multiple = 0;                  ///< lost(v) / (pi lost_avg)
  LostDensity density;
};

/// The factor that makes Blinn-Phong's reflectance at normal view 1 (models.h).
inline float blinn_phong_peak(float n) { return (n + 2) * (n + 4) / (8 * pi * (std::exp2(-n / 2) + n)); }

inline PowerLobe bare_power_lobe(const Scatter& s, Vec3f view) {
  PowerLobe lobe;
  lobe.view = view;
  lobe.exponent = s.exponent;
  lobe.half = s.model == ScatterModel::blinn_phong;
  lobe.peak = lobe.half ? blinn_phong_peak(s.exponent) : (s.exponent + 2) / (2 * pi);
  if (s.model == ScatterModel::phong) lobe.axis = {-view.x, -view.y, view.z};
  if (s.model == ScatterModel::lafortune) {
    const auto [cx, cy, cz] = s.lafortune_c;
    const Vec3f axis{cx * view.x, cy * view.y, cz * view.z};
    // |axis|^2 = 1 + grown for a unit view: exactly 1 for Phong's weights.
    const float grown =
        (cx * cx - 1) * view.x * view.x + (cy * cy - 1) * view.y * view.y + (cz * cz - 1) * view.z * view.z;
    const float length2 = dot(axis, axis);
    if (length2 > 1e-20f) {
      lobe.axis = (1 / std::sqrt(length2)) * axis;
      lobe.peak *= std::exp(s.exponent / 2 * (grown > -0.5f ? std::log1p(grown) : std::log(length2)));
    } else if (s.exponent > 0) {
      lobe.peak = 0;
    }
  }
  const float low = 1 / (1 + (lobe.half ? 0.25f : 1.0f) * s.exponent);
  lobe.p_cosine = low * low;
  lobe.p_lobe = 1 - lobe.p_cosine;
  return lobe;
}

inline PowerLobe make_power_lobe(const Scatter& s, Vec3f view) {
  PowerLobe lobe = bare_power_lobe(s, view);
  if (!s.compensated || !s.energy) return lobe;
  lobe.table = s.energy;
  const float lost = look_up_energy(*s.energy, view, 1).lost;
  const EnergyAverage average = look_up_average(*s.energy, 1);
  lobe.multiple = lost / (pi * average.lost);
  lobe.density = {average.spread, average.log_spread};
  lobe.p_lost = std::clamp(lost, 0.0f, 1.0f);
  lobe.p_lobe *= 1 - lobe.p_lost;
  lobe.p_cosine *= 1 - lobe.p_lost;
  return lobe;
}

/// cos^N, and the density of the light when the power is sampled.
struct Power {
  float value = 0, pdf = 0;
};

// Half vectors are sampled with (N + 2) / (2 pi) cos^(N+1); the light then has that over 4 (v.h).
inline Power power_of(const PowerLobe& lobe, Vec3f light) {
  if (lobe.half) {
    const Vec3f h = light + lobe.view;
    const float z2 = std::max(h.z * h.z, 1e-30f), squared = std::max(dot(h, h), 1e-30f);
    const float value = std::exp(-lobe.exponent / 2 * std::log1p((h.x * h.x + h.y * h.y) / z2));
    return {value, (lobe.exponent + 2) / (2 * pi) * value * h.z / (2 * squared)};
  }
  const Vec3f off = light - lobe.axis;
  const float missing = dot(off, off) / 2;
  if (missing >= 1) return {};
  const float value = std::exp(lobe.exponent * std::log1p(-missing));
  return {value, (lobe.exponent + 1) / (2 * pi) * value};
}

inline ScatterValue power_lobe_value(const PowerLobe& lobe, Rgb color, Vec3f light) {
  const Power power = power_of(lobe, light);
  float value = lobe.peak * power.value * light.z;
  float density = lobe.p_lobe * power.pdf + lobe.p_cosine * light.z / pi;
  if (lobe.table) {
    value += lobe.multiple * look_up_energy(*lobe.table, light, 1).lost * light.z;
    density += lobe.p_lost * lost_pdf(lobe.density, light.z);
  }
  return {value * color, density};
}

inline Vec3f sample_power_lobe(const PowerLobe& lobe, Vec2f u, float choice) {
  if (choice >= lobe.p_lobe)
    return choice < lobe.p_lobe + lobe.p_lost ? sample_lost(lobe.density, u) : sample_cosine(u);
  if (!lobe.half) return sample_cosine_power(lobe.axis, lobe.exponent, u);
  const Vec3f half = sample_cosine_power({0, 0, 1}, lobe.exponent + 1, u);
  return reflected(lobe.view, half);
}

/// Of a lobe without a table, within 0.15: fits to quadratures. Phong's falls like the cosine of its axis, Blinn-Phong's
/// like its square; 1 and (1 + cos) / 2 at N = 0 are exact.
inline float rough_albedo(const PowerLobe& lobe) {
  const float n = lobe.exponent;
  if (lobe.half) return (n * lobe.view.z * lobe.view.z + 1.5f) / (n + 1.5f);
  const float mean = (lobe.axis.z + std::sqrt(lobe.axis.z * lobe.axis.z + 1 / (1 + 1.3f * n))) / 2;
  return std::min(1.0f, lobe.peak * 2 * pi / (n + 2) * mean);
}

inline Rgb power_lobe_albedo(const Scatter& s, Vec3f view) {
  if (!s.energy) return rough_albedo(bare_power_lobe(s, view)) * s.color;
  return (s.compensated ? 1 : 1 - look_up_energy(*s.energy, view, 1).lost) * s.color;
}

}  // namespace welkin::scatter_detail
