#pragma once
#include <array>
#include <functional>
#include <string>

namespace welkin {

/// An isotropic BRDF: reflected radiance over irradiance, per steradian, linear Rec. 709. `value` takes the cosines of
/// light and view from the surface normal, both in (0, 1], and the azimuth between the two in [0, pi]: 0 where light and
/// view lie on the same side of the normal, pi in the mirror's configuration. Finite, >= 0, without the cosine of the
/// rendering equation, and safe to call from several threads.
struct IsotropicBrdf {
  std::string name;  ///< "ggx alpha 0.25, f0 0.04" and the like, for reports
  std::function<std::array<double, 3>(double cos_light, double cos_view, double azimuth)> value;
  /// The angle (rad) of the light over which the value varies where it varies fastest: quadratures scale with it.
  double angular_width = 1;
};

}  // namespace welkin
