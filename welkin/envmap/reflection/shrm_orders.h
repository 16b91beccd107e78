#pragma once
#include <array>
#include <span>
#include <vector>

#include <welkin/envmap/reflection/brdf_spectrum.h>
#include <welkin/sh/spectrum.h>

// What spherical-harmonic reflection maps need to know before any map is made: the expansion of a BRDF over the view,
// and the error that each choice of orders leaves. Private to the reflection methods.

namespace welkin {

/// Gauss-Legendre in the cosine of the view from the normal, on [0, 1]; weights sum to 1.
struct ViewNodes {
  std::vector<double> cos_view, weight;
};
ViewNodes make_view_nodes(int count);

/// |a_lm|^2 of a map by degree, averaged over the 2l + 1 orders m, for each channel.
std::vector<std::array<double, 3>> mean_coefficient_power(const Spectrum& radiance);

/// The functions of the view, P_pq(cos theta_v) exp(i q phi_v), that a map of this order keeps: (p, q), q <= p <=
/// order, sorted by q. About the reflected direction theta_v = 2 theta_o, so that views fill the sphere. About the
/// normal the BRDF is continued below the horizon as its mirror image, theta_v = theta_o, and only even p - q are
/// there.
struct ViewTerm {
  int p = 0, q = 0;
};
std::vector<ViewTerm> view_terms(ReflectionFrame frame, int order);

/// cos theta_v of a view that makes cos_view with the normal.
double view_polar_cosine(ReflectionFrame frame, double cos_view);

/// rho_lpq: the coefficients over the view of t_lq (brdf_spectrum.h), so that t_lq ~ sum over p of rho_lpq P_pq.
struct ViewExpansion {
  std::vector<ViewTerm> terms;
  int max_degree = 0, channels = 1;
  std::vector<double> values;  ///< [(term * (max_degree + 1) + l) * channels + channel]

  double at(std::size_t term, int l, int channel) const {
    return values[(term * (max_degree + 1) + l) * channels + channel];
  }
};

/// `table` was made at the cosines of `nodes`; order <= table.max_order, max_degree <= table.max_degree.
ViewExpansion expand_views(const BrdfSpectrum& table, const ViewNodes& nodes, int max_degree, int order);

/// Mean square of the reflected radiance and of what is left out, over all orientations of the surface and views
/// uniform in their cosine over [smallest_cos_view, 1], summed over the three channels.
struct OrderErrors {
  double signal = 0;
  double beyond_table = 0;                ///< of the BRDF's degrees above the reference table (an estimate)
  std::vector<double> dropped;            ///< [l]: if degree l is left out altogether
  std::vector<std::vector<double>> kept;  ///< [order][l]: if it is kept with this order of the view

  /// Mean square of the error with degrees up to max_degree and this order.
  double error(int max_degree, int order) const;
  /// Its root over that of the signal; 0 where there is no signal.
  double relative_error(int max_degree, int order) const;
};

/// `reference` (any frame, the highest degree there is) gives the energy of each degree; `table` and `expansion`
/// say what is kept. Both tables have max_order = max_degree and the cosines of `nodes`.
OrderErrors order_errors(std::span<const std::array<double, 3>> power, const BrdfSpectrum& reference,
                         const BrdfSpectrum& table, const ViewExpansion& expansion, const ViewNodes& nodes,
                         double smallest_cos_view);

}  // namespace welkin
