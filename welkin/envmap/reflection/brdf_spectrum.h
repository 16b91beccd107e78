#pragma once
#include <span>
#include <vector>

#include <welkin/brdf/isotropic.h>

namespace welkin {

/// The axis of the local frame in which a BRDF is expanded.
enum class ReflectionFrame {
  normal,  ///< the surface's normal
  reflected  ///< the view mirrored about the normal: glossy lobes stay near the pole (Ramamoorthi & Hanrahan 2002)
};

/// The product of an isotropic BRDF and the light's cosine, f cos+, as functions of the light's direction: spherical
/// harmonics about the axis of `frame` for each of several view angles. The view has azimuth 0 there, so that
///   f cos+ (theta', phi') = sum over l of [ t_l0 P_l0 + 2 sum_(q>0) t_lq P_lq(cos theta') cos(q phi') ],
/// with P_lq orthonormal without Condon-Shortley sign; t is real.
struct BrdfSpectrum {
  ReflectionFrame frame = ReflectionFrame::reflected;
  int max_degree = 0;  ///< of l
  int max_order = 0;   ///< of q, <= max_degree
  int channels = 1;    ///< 1 where all three channels of the BRDF are equal
  std::vector<double> cos_views;
  std::vector<double> values;  ///< t, see at(); the views of one coefficient follow each other
  std::vector<double>
      total_energy;  ///< [channel * views + view]: integral of (f cos+)^2 over the light, 1/sr

  int views() const { return static_cast<int>(cos_views.size()); }
  /// The coefficients of all views, 0 <= q <= max_order, q <= l <= max_degree.
  const double* at(int l, int q, int channel) const { return values.data() + index(l, q, channel); }
  double* at(int l, int q, int channel) { return values.data() + index(l, q, channel); }

 private:
  std::size_t index(int l, int q, int channel) const {
    const auto pair = static_cast<std::size_t>(q) * static_cast<std::size_t>(2 * max_degree + 3 - q) / 2 +
                      static_cast<std::size_t>(l - q);
    return (pair * channels + channel) * cos_views.size();
  }
};

/// The narrowest angular width (rad) that the quadratures resolve.
inline constexpr double narrowest_brdf = 0.02;

/// The degree up to which a BRDF of this angular width has content worth a table: about 8/width, within [24, limit].
int brdf_degree(double angular_width, int limit);

/// By a product quadrature: Gauss-Legendre in the polar cosine, equal steps in azimuth, both fine enough for
/// max_degree and for the BRDF's angular width. Every cosine of a view is in (0, 1], max_order <= max_degree.
/// Throws Error where the BRDF is narrower than narrowest_brdf, or gives a value that is negative or not finite.
BrdfSpectrum make_brdf_spectrum(const IsotropicBrdf& brdf, ReflectionFrame frame, int max_degree,
                                int max_order, std::span<const double> cos_views);

}  // namespace welkin
