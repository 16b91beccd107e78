#pragma once
#include <welkin/brdf/scatter/energy_table.h>
#include <welkin/brdf/scatter/fresnel.h>
#include <welkin/brdf/scatter/microfacet.h>
#include <welkin/brdf/scatter/scatter.h>

// The GGX models as a sum of three lobes: facets, light between facets, and a diffuse base under them.
//   facets    F D V
//   multiple  k(F) (1 - E(l)) (1 - E(v)) / (pi (1 - E_avg)),   k = F_avg^2 E_avg / (1 - F_avg (1 - E_avg))
//             with E of white facets (Kulla & Conty 2017)
//   diffuse   albedo (1 - C(l)) (1 - C(v)) / (pi (1 - C_avg)),   C = f0 (1 - lost) + (f90 - f0) bias + k(f0) lost,
//             all that the coat of reflectance f0 sends back (Kelemen & Szirmay-Kalos 2001).
// One lobe is chosen with a probability in proportion to the largest channel of what it reflects of this view.

namespace welkin::scatter_detail {

/// What a coat reflects, as a straight line in a table's Energy.
struct CoatEnergy {
  float constant = 0, of_lost = 0, of_bias = 0;
  float operator()(Energy e) const { return constant + of_lost * e.lost + of_bias * e.bias; }
};

struct Layers {
  MicrofacetView facets;
  const EnergyTable* table = nullptr;  ///< null where only the facets count
  float alpha = 1;                     ///< for the table
  bool conductor = false;              ///< exact term with eta, k; else Schlick's with f0, f90
  bool smooth = false;                 ///< the facets are a mirror
  Rgb f0, f90, eta, k;
  Rgb multiple;  ///< of the lobe without (1 - E(l))
  float spread = 1;
  Rgb diffuse;  ///< of the lobe without (1 - C(l))
  CoatEnergy coat;
  float p_facets = 1, p_multiple = 0, p_diffuse = 0;
  Rgb albedo;  ///< of the whole; filled where a table is read
};

Layers make_layers(const Scatter& scatter, Vec3f view);
/// Directional albedo; of GGX that is not compensated too.
Rgb layers_albedo(const Scatter& scatter, Vec3f view);
/// Needs light.z > 0 and view.z > 0.
ScatterValue layers_value(const Layers& layers, Vec3f light);
ScatterSample sample_layers(const Layers& layers, Vec2f u, float lobe);

}  // namespace welkin::scatter_detail
