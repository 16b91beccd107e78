#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <welkin/brdf/scatter/scatter.h>
#include <welkin/geometry/vec3f.h>

// How much a lobe reflects of a constant environment, by direction: what is left over goes to other lobes, and what is
// lost can be given back. With E(v) the directional albedo and E_avg = integral of E(v) cos / pi,
//   (1 - E(v)) (1 - E(l)) / (pi (1 - E_avg))
// is reciprocal and reflects exactly 1 - E(v) (Kelemen & Szirmay-Kalos 2001; Kulla & Conty 2017).

namespace welkin {

/// lost = 1 - E of white facets (of other lobes: of the lobe with color 1), and `bias`, the share of Schlick's weight:
/// a GGX lobe with f0, f90 reflects f0 (1 - lost) + (f90 - f0) bias.
struct Energy {
  float lost = 0, bias = 0;
};

/// The same averaged with cos / pi over the hemisphere, and the density that samples lost cos (warps.h).
struct EnergyAverage {
  float lost = 0, bias = 0;
  float spread = 1, log_spread = 0.69314718f;  ///< and log(1 + 1 / spread)
};

/// Row by row; the columns are cosines (energy_axis).
struct EnergyTable {
  static constexpr int columns = 128;
  bool by_azimuth =
      false;  ///< rows: perceptual roughness in [0, 1], all widths at once; or azimuth, one width
  int rows = 0;
  float alpha = 1;                      ///< by azimuth: the width that the axis of the columns is made for
  std::vector<Energy> energies;         ///< rows * columns
  std::vector<EnergyAverage> averages;  ///< over perceptual roughness in equal steps; one entry by azimuth
};

/// The table that serves all isotropic GGX widths: made on first use (0.05 s) and then shared. Models of GGX whose
/// `energy` is null read it.
const EnergyTable& ggx_energy_table();

/// Whether a `compensated` Scatter needs a table of its own: Phong, Blinn-Phong, Lafortune and anisotropic GGX.
/// Without one they stay uncompensated.
bool needs_energy_table(const Scatter& scatter);

/// The table for this model, exponent and width, within 3e-4; for models where needs_energy_table is false a copy of
/// ggx_energy_table. Takes 0.1 s. Throws Error for a Lafortune lobe that reflects more than arrives.
EnergyTable make_energy_table(const Scatter& scatter);

/// Where a cosine lies on the axis of columns, in [0, 1]. E_white rises to 1 at grazing angles within a few alpha: half of
/// the axis goes with cos / alpha, the other half with the root of cos, for Schlick's term.
inline float energy_axis(float cosine, float alpha) {
  const float c = std::clamp(cosine, 0.0f, 1.0f), a = std::max(alpha, 1e-4f);
  return (std::sqrt(c) + c * (1 + a) / (c + a)) / 2;
}

/// Bilinear. `alpha` is read by tables over perceptual roughness only.
inline Energy look_up_energy(const EnergyTable& table, Vec3f direction, float alpha) {
  float row = 0;
  if (!table.by_azimuth) {
    row = std::sqrt(std::clamp(alpha, 0.0f, 1.0f));
  } else if (table.rows > 1) {  // all four quadrants are the same
    const float x = std::abs(direction.x), y = std::abs(direction.y);
    row = x + y > 0 ? y / (x + y) : 0;
  }
  const float u = energy_axis(direction.z, table.by_azimuth ? table.alpha : alpha) * (table.columns - 1);
  row *= static_cast<float>(table.rows - 1);
  const int i = std::min(static_cast<int>(u), table.columns - 2);
  const int j = std::clamp(static_cast<int>(row), 0, std::max(0, table.rows - 2));
  const float s = u - static_cast<float>(i), t = row - static_cast<float>(j);
  const Energy* low = table.energies.data() + j * table.columns + i;
  const Energy* high = table.rows > 1 ? low + table.columns : low;
  const auto mix = [s, t](float a, float b, float c, float d) {
    const float first = a + s * (b - a);
    return first + t * (c + s * (d - c) - first);
  };
  return {mix(low[0].lost, low[1].lost, high[0].lost, high[1].lost),
          mix(low[0].bias, low[1].bias, high[0].bias, high[1].bias)};
}

inline EnergyAverage look_up_average(const EnergyTable& table, float alpha) {
  const int last = static_cast<int>(table.averages.size()) - 1;
  if (last <= 0) return table.averages[0];
  const float at = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * static_cast<float>(last);
  const int i = std::min(static_cast<int>(at), last - 1);
  const float t = at - static_cast<float>(i);
  const EnergyAverage &a = table.averages[i], &b = table.averages[i + 1];
  // A density's two numbers belong together: those of one step.
  return {a.lost + t * (b.lost - a.lost), a.bias + t * (b.bias - a.bias), b.spread, b.log_spread};
}

}  // namespace welkin
