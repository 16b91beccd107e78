#include <welkin/brdf/scatter/energy_table.h>

#include <cmath>

#include <welkin/brdf/dfg.h>

namespace welkin {
namespace {

constexpr int roughness_rows = 64, average_steps = 512, average_nodes = 256;

// The cosine of a column: energy_axis is increasing, so bisection.
double cosine_of_column(int column, double alpha) {
  const double wanted = static_cast<double>(column) / (EnergyTable::columns - 1);
  const double a = std::max(alpha, 1e-4);
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double c = (low + high) / 2;
    ((std::sqrt(c) + c * (1 + a) / (c + a)) / 2 < wanted ? low : high) = c;
  }
  return (low + high) / 2;
}

// Averages of what look-ups give (so that the lobe made of both balances), over c = x^3, which crowds at grazing angles.
// A density c / ((c^2 + s) L), L = log(1 + 1 / s), estimates the integral of W c, W = 1 - E, with the second moment
//   integral of (W c)^2 (c^2 + s) L / c dc = L(s) (integral of W^2 c^3 + s integral of W^2 c):
// s is where that is least, on a grid of a quarter of a power of two.
EnergyAverage average_of(const EnergyTable& table, float alpha) {
  const int azimuths = table.by_azimuth && table.rows > 1 ? 64 : 1;
  double scale = 0, bias = 0, cubic = 0, linear = 0;
  for (int i = 0; i < average_nodes; ++i)
    for (int j = 0; j < azimuths; ++j) {
      const double x = (i + 0.5) / average_nodes, c = x * x * x;
      const double phi = (j + 0.5) / azimuths * 1.5707963267948966;
      const Vec3f direction{static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi)),
                            static_cast<float>(c)};
      const Energy e = look_up_energy(table, direction, alpha);
      const double weight = 2 * c * 3 * x * x / average_nodes / azimuths;
      const double lost = 1.0 - e.scale - e.bias;
      scale += weight * e.scale;
      bias += weight * e.bias;
      cubic += weight * lost * lost * c * c;
      linear += weight * lost * lost;
    }
  double best = 1, least = INFINITY;
  for (int i = -100; i <= 40; ++i) {
    const double s = std::exp2(i / 4.0), moment = std::log1p(1 / s) * (cubic + s * linear);
    if (moment < least) best = s, least = moment;
  }
  return {static_cast<float>(scale), static_cast<float>(bias), static_cast<float>(best)};
}

EnergyTable make_ggx_table() {
  EnergyTable table;
  table.rows = roughness_rows;
  table.energies.resize(static_cast<std::size_t>(roughness_rows) * EnergyTable::columns);
  for (int j = 0; j < roughness_rows; ++j)
    for (int i = 0; i < EnergyTable::columns; ++i) {
      const double roughness = static_cast<double>(j) / (roughness_rows - 1), alpha = roughness * roughness;
      const DfgValue value = integrate_dfg(cosine_of_column(i, alpha), alpha);
      table.energies[static_cast<std::size_t>(j) * EnergyTable::columns + i] = {
          static_cast<float>(value.scale), static_cast<float>(value.bias)};
    }
  for (int i = 0; i < average_steps; ++i) {
    const float roughness = static_cast<float>(i) / (average_steps - 1);
    table.averages.push_back(average_of(table, roughness * roughness));
  }
  return table;
}

}  // namespace

// One thread: many may wait for it from inside a parallel loop.
const EnergyTable& ggx_energy_table() {
  static const EnergyTable shared = make_ggx_table();
  return shared;
}

bool needs_energy_table(const Scatter& scatter) {
  switch (scatter.model) {
    case ScatterModel::phong:
    case ScatterModel::blinn_phong:
    case ScatterModel::lafortune: return true;
    case ScatterModel::ggx:
    case ScatterModel::ggx_conductor:
    case ScatterModel::metallic_roughness: return scatter.alpha_x != scatter.alpha_y;
    default: return false;
  }
}

EnergyTable make_energy_table(const Scatter&) { return ggx_energy_table(); }

}  // namespace welkin
