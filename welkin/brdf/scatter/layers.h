#pragma once
#include <cmath>

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

// Passing a Layers through memory, and clearing it, costs more than what is done with it (GGX: 60 ns, 23 without).
#if defined(__GNUC__)
#define WELKIN_SCATTER_INLINE [[gnu::always_inline]] inline
#else
#define WELKIN_SCATTER_INLINE inline
#endif

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
  const Scatter* scatter = nullptr;    ///< of a conductor's eta, k
  Rgb f0, f90;
  Rgb multiple;  ///< of the lobe without (1 - E(l))
  LostDensity density;
  Rgb diffuse;  ///< of the lobe without (1 - C(l))
  CoatEnergy coat;
  float p_facets = 1, p_multiple = 0, p_diffuse = 0;
};

inline constexpr Rgb white{1, 1, 1};

inline Rgb mixed(Rgb a, Rgb b, float t) { return (1 - t) * a + t * b; }

inline float multiple_colour(float fresnel, float average) {
  return fresnel * fresnel * average / (1 - fresnel * (1 - average));
}

inline Rgb multiple_colour(Rgb fresnel, float average) {
  return {multiple_colour(fresnel.r, average), multiple_colour(fresnel.g, average),
          multiple_colour(fresnel.b, average)};
}

inline Rgb average_schlick(Rgb f0, Rgb f90) { return f0 + (1.0f / 21) * (f90 - f0); }

WELKIN_SCATTER_INLINE Rgb facet_fresnel(const Layers& layers, float cosine) {
  if (layers.conductor) return fresnel_conductor(cosine, layers.scatter->eta, layers.scatter->k);
  return mixed(layers.f0, layers.f90, schlick_weight(cosine));
}

inline bool has_base(const Scatter& scatter) {
  return scatter.model == ScatterModel::coated_diffuse || scatter.model == ScatterModel::metallic_roughness;
}

// Facets and the colours of their Fresnel term.
WELKIN_SCATTER_INLINE Layers bare_layers(const Scatter& scatter, Vec3f view) {
  Layers layers;
  layers.conductor = scatter.model == ScatterModel::ggx_conductor;
  layers.smooth = scatter.model == ScatterModel::coated_diffuse && scatter.alpha_x <= 0;
  const float alpha_y = scatter.model == ScatterModel::coated_diffuse ? scatter.alpha_x : scatter.alpha_y;
  layers.facets = microfacet_view(view, scatter.alpha_x, alpha_y);
  const float x = layers.facets.alpha_x, y = layers.facets.alpha_y;
  layers.alpha = x == y ? x : std::sqrt((x * x + y * y) / 2);
  layers.scatter = &scatter;
  layers.f0 = has_base(scatter) ? scatter.f0 * white : scatter.color;
  layers.f90 = scatter.f90 * white;
  if (scatter.model == ScatterModel::metallic_roughness) {
    layers.f0 = mixed(layers.f0, scatter.color, scatter.metallic);
    layers.f90 = mixed(layers.f90, white, scatter.metallic);
  }
  return layers;
}

// A table over perceptual roughness has no anisotropic energies: compensation with it could reflect more than arrives.
inline bool compensates(const Scatter& scatter, const Layers& layers) {
  return scatter.compensated && !layers.smooth &&
         (layers.facets.alpha_x == layers.facets.alpha_y || (scatter.energy && scatter.energy->by_azimuth));
}

inline Energy energy_of(const Layers& layers, Vec3f direction) {
  if (!layers.smooth) return look_up_energy(*layers.table, direction, layers.alpha);
  const float weight = schlick_weight(direction.z);
  return {0, weight};
}

struct Balance {
  Energy view;
  EnergyAverage average;
  float average_white = 1;  // E_avg of white facets
};

inline Balance balance_of(const Layers& layers) {
  Balance b;
  b.view = energy_of(layers, layers.facets.view);
  b.average = layers.smooth ? EnergyAverage{0, 1.0f / 21, 1} : look_up_average(*layers.table, layers.alpha);
  b.average_white = 1 - b.average.lost;
  return b;
}

inline float normal_reflectance(float eta, float k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

// What the facets reflect; of a conductor as if its term were Schlick's.
inline Rgb facets_albedo(const Layers& layers, const Balance& b) {
  const Rgb f0 = layers.conductor ? Rgb{normal_reflectance(layers.scatter->eta.r, layers.scatter->k.r),
                                        normal_reflectance(layers.scatter->eta.g, layers.scatter->k.g),
                                        normal_reflectance(layers.scatter->eta.b, layers.scatter->k.b)}
                                  : layers.f0;
  return (1 - b.view.lost - b.view.bias) * f0 + b.view.bias * (layers.conductor ? white : layers.f90);
}

// k(F) of the facets. Dielectric and metal of metallic_roughness are mixed, so that both being white is white.
inline Rgb multiple_of(const Scatter& scatter, const Layers& layers, const Balance& b) {
  if (layers.conductor)
    return multiple_colour(average_fresnel_conductor(layers.scatter->eta, layers.scatter->k),
                           b.average_white);
  if (scatter.model != ScatterModel::metallic_roughness)
    return multiple_colour(average_schlick(layers.f0, layers.f90), b.average_white);
  const Rgb dielectric =
      multiple_colour(average_schlick(scatter.f0 * white, scatter.f90 * white), b.average_white);
  return mixed(dielectric, multiple_colour(average_schlick(scatter.color, white), b.average_white),
               scatter.metallic);
}

inline CoatEnergy coat_of(const Scatter& scatter, const Balance& b, bool compensated) {
  const float average = scatter.f0 + (scatter.f90 - scatter.f0) / 21;
  const float k = compensated ? multiple_colour(average, b.average_white) : 0;
  return {scatter.f0, k - scatter.f0, scatter.f90 - scatter.f0};
}

WELKIN_SCATTER_INLINE Layers make_layers(const Scatter& scatter, Vec3f view, Rgb* albedo = nullptr) {
  Layers layers = bare_layers(scatter, view);
  const bool compensated = compensates(scatter, layers);
  const bool base = has_base(scatter);
  if (!compensated && !base) return layers;
  layers.table = scatter.energy ? scatter.energy : &ggx_energy_table();
  const Balance b = balance_of(layers);
  const Rgb facets = facets_albedo(layers, b);
  float m_multiple = 0, m_diffuse = 0;
  if (albedo) *albedo = facets;
  if (compensated) {
    const Rgb reflected = b.view.lost * multiple_of(scatter, layers, b);
    layers.multiple = (1 / (pi * b.average.lost)) * reflected;
    layers.density = {b.average.spread, b.average.log_spread};
    if (albedo) *albedo += reflected;
    m_multiple = max_channel(reflected);
  }
  if (base) {
    layers.coat = coat_of(scatter, b, compensated);
    const float metal = scatter.model == ScatterModel::metallic_roughness ? scatter.metallic : 0;
    const float passed = std::max(0.0f, 1 - layers.coat(b.view));
    const float average = layers.coat({b.average.lost, b.average.bias});
    const Rgb reflected = ((1 - metal) * passed) * scatter.color;
    layers.diffuse = average < 1 ? (1 / (pi * (1 - average))) * reflected : Rgb{};
    if (albedo) *albedo += reflected;
    m_diffuse = average < 1 ? max_channel(reflected) : 0;
  }
  const float m_facets = max_channel(facets), sum = m_facets + m_multiple + m_diffuse;
  if (!(sum > 0)) return layers;
  layers.p_multiple = m_multiple / sum;
  layers.p_diffuse = m_diffuse / sum;
  layers.p_facets = m_facets / sum;
  return layers;
}

inline Rgb layers_albedo(const Scatter& scatter, Vec3f view) {
  Rgb albedo;
  Layers layers = make_layers(scatter, view, &albedo);
  if (layers.table) return albedo;
  layers.table = scatter.energy ? scatter.energy : &ggx_energy_table();
  return facets_albedo(layers, balance_of(layers));
}

WELKIN_SCATTER_INLINE ScatterValue layers_value(const Layers& layers, Vec3f light) {
  ScatterValue result;
  if (!layers.smooth) {
    const Facet facet = facet_of(layers.facets, light);
    result.value =
        reflected_share(layers.facets, light, facet.distribution) * facet_fresnel(layers, facet.cosine);
    result.pdf = layers.p_facets * microfacet_pdf(layers.facets, facet.distribution);
  }
  if (!layers.table) return result;
  const Energy energy = energy_of(layers, light);
  if (layers.p_multiple > 0) {
    result.value += (energy.lost * light.z) * layers.multiple;
    result.pdf += layers.p_multiple * lost_pdf(layers.density, light.z);
  }
  if (layers.p_diffuse > 0) {
    result.value += (std::max(0.0f, 1 - layers.coat(energy)) * light.z) * layers.diffuse;
    result.pdf += layers.p_diffuse * light.z / pi;
  }
  return result;
}

WELKIN_SCATTER_INLINE ScatterSample sample_layers(const Layers& layers, Vec2f u, float lobe) {
  ScatterSample result;
  if (lobe < layers.p_facets) {
    const Vec3f view = layers.facets.view;
    if (layers.smooth) {
      const Rgb fresnel = facet_fresnel(layers, view.z);
      return {{-view.x, -view.y, view.z}, (1 / layers.p_facets) * fresnel, INFINITY};
    }
    result.light = sample_microfacet(layers.facets, u);
  } else if (lobe < layers.p_facets + layers.p_multiple) {
    result.light = sample_lost(layers.density, u);
  } else {
    result.light = sample_cosine(u);
  }
  if (!(result.light.z > 0)) return {};
  const ScatterValue value = layers_value(layers, result.light);
  if (!(value.pdf > 0)) return {};
  result.pdf = value.pdf;
  result.weight = (1 / value.pdf) * value.value;
  return result;
}

}  // namespace welkin::scatter_detail
