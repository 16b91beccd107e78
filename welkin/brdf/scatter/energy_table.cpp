#include <welkin/brdf/scatter/energy_table.h>

#include <cmath>
#include <numbers>

#include <welkin/brdf/dfg.h>
#include <welkin/brdf/scatter/fresnel.h>
#include <welkin/brdf/scatter/microfacet.h>
#include <welkin/brdf/scatter/power_lobe.h>
#include <welkin/error.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

using namespace scatter_detail;

constexpr int roughness_rows = 64, azimuth_rows = 17, average_steps = 512, average_nodes = 256;
constexpr double least_lost = 1e-12;  // so that nothing is divided by 0

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
// A density c / ((c^2 + s) L), L = log(1 + 1 / s), estimates the integral of W c, W = lost, with the second moment
//   integral of (W c)^2 (c^2 + s) L / c dc = L(s) (integral of W^2 c^3 + s integral of W^2 c):
// s is where that is least, on a grid of a quarter of a power of two.
EnergyAverage average_of(const EnergyTable& table, float alpha) {
  const int azimuths = table.by_azimuth && table.rows > 1 ? 64 : 1;
  double lost = 0, bias = 0, cubic = 0, linear = 0, weights = 0;
  for (int i = 0; i < average_nodes; ++i)
    for (int j = 0; j < azimuths; ++j) {
      const double x = (i + 0.5) / average_nodes, c = x * x * x;
      const double phi = (j + 0.5) / azimuths * std::numbers::pi / 2;
      const Vec3f direction{static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi)),
                            static_cast<float>(c)};
      const Energy e = look_up_energy(table, direction, alpha);
      const double weight = c * x * x, w = e.lost;
      weights += weight;
      lost += weight * w;
      bias += weight * e.bias;
      cubic += weight * w * w * c * c;
      linear += weight * w * w;
    }
  double best = 1, least = INFINITY;
  for (int i = -100; i <= 8; ++i) {
    const double s = std::exp2(i / 4.0), moment = std::log1p(1 / s) * (cubic + s * linear);
    if (moment < least) best = s, least = moment;
  }
  return {static_cast<float>(std::max(least_lost, lost / weights)), static_cast<float>(bias / weights),
          static_cast<float>(best), static_cast<float>(std::log1p(1 / best))};
}

EnergyTable make_ggx_table() {
  EnergyTable table;
  table.rows = roughness_rows;
  for (int j = 0; j < roughness_rows; ++j)
    for (int i = 0; i < EnergyTable::columns; ++i) {
      const double roughness = static_cast<double>(j) / (roughness_rows - 1), alpha = roughness * roughness;
      const DfgValue value = integrate_dfg(cosine_of_column(i, alpha), alpha);
      table.energies.push_back(
          {static_cast<float>(std::max(least_lost, 1 - value.albedo())), static_cast<float>(value.bias)});
    }
  for (int i = 0; i < average_steps; ++i) {
    const float roughness = static_cast<float>(i) / (average_steps - 1);
    table.averages.push_back(average_of(table, roughness * roughness));
  }
  return table;
}

// A view of a table's node; azimuths as in look_up_energy.
Vec3f node_direction(double cosine, int row, int rows) {
  const double y = rows > 1 ? static_cast<double>(row) / (rows - 1) : 0, x = 1 - y;
  const double sine = std::sqrt((1 - cosine) * (1 + cosine)) / std::hypot(x, y);
  return {static_cast<float>(sine * x), static_cast<float>(sine * y),
          static_cast<float>(std::max(cosine, 1e-7))};
}

// The mean weight of visible normals: G2 / G1, and with Schlick's weight.
Energy facets_energy(const Scatter& s, Vec3f view) {
  constexpr int radii = 64, turns = 48;
  const MicrofacetView facets = microfacet_view(view, s.alpha_x, s.alpha_y);
  double all = 0, bias = 0;
  for (int i = 0; i < radii; ++i)
    for (int j = 0; j < turns; ++j) {
      const Vec3f light = sample_microfacet(
          facets, {(static_cast<float>(i) + 0.5f) / radii, (static_cast<float>(j) + 0.5f) / turns});
      if (!(light.z > 0)) continue;
      const Facet facet = facet_of(facets, light);
      const double weight = reflected_share(facets, light, 1) / microfacet_pdf(facets, 1);
      all += weight;
      bias += weight * schlick_weight(facet.cosine);
    }
  return {static_cast<float>(1 - all / (radii * turns)), static_cast<float>(bias / (radii * turns))};
}

// max(0, p + q cos) averaged over the circle, q >= 0.
double mean_above(double p, double q) {
  if (p >= q) return p;
  if (p <= -q) return 0;
  const double end = std::acos(-p / q);
  return (p * end + q * std::sin(end)) / std::numbers::pi;
}

// cos^N about an axis: at the cosine c from the axis the light's mean height above the horizon is in closed form.
double power_energy(const PowerLobe& lobe) {
  constexpr int nodes = 256;
  const double n = lobe.exponent, up = std::clamp<double>(lobe.axis.z, -1, 1);
  const double across = std::sqrt(1 - up * up);
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double c = std::pow((i + 0.5) / nodes, 1 / (n + 1));
    sum += mean_above(up * c, across * std::sqrt((1 - c) * (1 + c)));
  }
  return lobe.peak * 2 * std::numbers::pi / (n + 1) * sum / nodes;
}

// Blinn-Phong: the mean over half vectors of density cos^(N+1) of 4 (v.h) l.z / h.z, l.z = 2 (v.h) h.z - v.z. At a given
// c = h.z, v.h = a + b x with x = cos of the azimuth, and where l.z > 0 (|azimuth| < end) the product is quadratic in x.
double half_energy(const PowerLobe& lobe) {
  constexpr int nodes = 1024;
  const double n = lobe.exponent, vz = std::clamp<double>(lobe.view.z, 0, 1);
  const double sine = std::sqrt((1 - vz) * (1 + vz));
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    const double c = std::pow((i + 0.5) / nodes, 1 / (n + 2)), a = vz * c,
                 b = sine * std::sqrt((1 - c) * (1 + c));
    const double from = vz / (2 * c) - a;  // v.h above this
    if (from >= b) continue;
    const double end = from <= -b ? std::numbers::pi : std::acos(from / b);
    const double constant = 2 * c * a * a - vz * a, linear = (4 * c * a - vz) * b, square = 2 * c * b * b;
    sum += (constant * end + linear * std::sin(end) + square * (end / 2 + std::sin(2 * end) / 4)) / c;
  }
  return 4 * lobe.peak * 2 / (n + 2) * sum / nodes;
}

bool is_power(const Scatter& s) {
  return s.model == ScatterModel::phong || s.model == ScatterModel::blinn_phong ||
         s.model == ScatterModel::lafortune;
}

Energy node_energy(const Scatter& s, Vec3f view) {
  if (!is_power(s)) return facets_energy(s, view);
  const PowerLobe lobe = bare_power_lobe(s, view);
  return {static_cast<float>(1 - (lobe.half ? half_energy(lobe) : power_energy(lobe))), 0};
}

int azimuth_rows_of(const Scatter& s) {
  const bool round = s.model == ScatterModel::lafortune
                         ? std::abs(s.lafortune_c[0]) == std::abs(s.lafortune_c[1])
                         : is_power(s);
  return round ? 1 : azimuth_rows;
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

EnergyTable make_energy_table(const Scatter& scatter) {
  if (!needs_energy_table(scatter)) return ggx_energy_table();
  EnergyTable table;
  table.by_azimuth = true;
  table.rows = azimuth_rows_of(scatter);
  table.alpha = is_power(scatter) ? std::sqrt(2 / (scatter.exponent + 2))
                                  : std::max(1e-3f, std::sqrt(scatter.alpha_x * scatter.alpha_y));
  const std::size_t nodes = static_cast<std::size_t>(table.rows) * EnergyTable::columns;
  table.energies.resize(nodes);
  parallel_for(nodes, 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int column = static_cast<int>(i % EnergyTable::columns);
      const int row = static_cast<int>(i / EnergyTable::columns);
      table.energies[i] =
          node_energy(scatter, node_direction(cosine_of_column(column, table.alpha), row, table.rows));
    }
  });
  for (Energy& e : table.energies) {
    if (e.lost < -1e-3f)
      throw Error("this Lafortune lobe reflects more light than arrives: it cannot be compensated");
    e.lost = std::max(static_cast<float>(least_lost), e.lost);
  }
  table.averages.push_back(average_of(table, table.alpha));
  return table;
}

}  // namespace welkin
