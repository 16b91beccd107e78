#pragma once
#include <array>
#include <span>
#include <vector>

#include <welkin/brdf/isotropic.h>

// Radially symmetric lobes fitted to an isotropic BRDF, one fit a view elevation (Kautz & McCool 2000). A lobe is a
// function of the angle theta from its axis, which lies in the plane of incidence. An environment filtered with the lobe
// and looked up along the axis is then the light that the lobe reflects.

namespace welkin {

enum class LobeFamily {
  free,  ///< any shape: for a given axis the mean over rings about it is the least-squares answer, in closed form
  ggx,    ///< D(theta/2, alpha) cos theta, the kernel "ggx" of zonal_kernel.h; parameter alpha
  phong,  ///< cos^N theta; parameter N
};

enum class LobeTarget {
  brdf_times_cosine,  ///< f cos_light, dark below the horizon: filters with it give reflected radiance at once
  brdf,  ///< f alone over the lights above the horizon; the cosine is taken out as n.axis, as published
};

struct LobeFitOptions {
  int lobes = 1;  ///< 1 to 4, greedy: each fits what those before leave, then all are fitted anew in turn
  LobeFamily family = LobeFamily::free;
  LobeTarget target = LobeTarget::brdf_times_cosine;
};

struct FittedLobe {
  double axis =
      0;  ///< rad from the normal, > 0 on the side away from the view: the mirror direction is view_angle
  double parameter = 0;  ///< alpha or N of its family
  /// The shape, per steradian and with integral 1, at the angles of lobe_angles(); >= 0.
  std::vector<double> values;
  std::array<double, 3> energy{};  ///< what the shape is multiplied by, a channel; >= 0
};

struct LobeFit {
  double view_angle = 0;  ///< rad from the normal, below pi/2
  std::vector<FittedLobe> lobes;
  /// L2 norm over the sphere of (fit - target) over that of the target, luminance.
  double relative_error = 0;
};

/// The angles (rad, 0 to pi) that shapes are tabulated at: fine beside the BRDF's angular width near the axis.
std::vector<double> lobe_angles(const IsotropicBrdf& brdf);

/// Fits each view on its own shapes, for ascending view angles; each starts from the axes of the one before, so that
/// lobe k of one view is the neighbour of lobe k of the next. With the target brdf_times_cosine the energies of a view
/// sum up to the directional albedo of each channel: a constant environment is reflected exactly. Shapes come from
/// luminance, energies from each channel by least squares. Throws Error for options or angles out of range.
std::vector<LobeFit> fit_lobes(const IsotropicBrdf& brdf, std::span<const double> view_angles,
                               const LobeFitOptions& options = {});

/// The single scaled lobe: one shape for all views, turned and scaled with the elevation; lobes must be 1. The shape is
/// the least-squares answer for the targets of all views, each scaled to energy 1 and weighted by the solid angle
/// that its view stands for; axes and shape are found in turn.
std::vector<LobeFit> fit_single_lobe(const IsotropicBrdf& brdf, std::span<const double> view_angles,
                                     const LobeFitOptions& options = {});

}  // namespace welkin
