#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <welkin/envmap/kernel_table.h>

namespace welkin {

enum class KernelKind { ggx, phong, lambert, gaussian, blinn_phong, von_mises_fisher, table };

/// A filter kernel that is radially symmetric about a direction: a function K of the angle theta between the
/// direction that is looked up and the direction that light comes from. Per steradian, >= 0, its integral over the
/// sphere is 1, so a constant environment passes unchanged.
///   ggx       D(theta/2, alpha) cos theta for theta < 90 degrees: the prefilter of real-time engines, n = v = r
///             (Karis 2013), D of Walter et al. 2007; alpha is the GGX width in (0, 1]
///   phong     cos^N theta, N >= 0, for theta < 90 degrees
///   lambert   cos theta / pi: irradiance / pi
///   gaussian  exp(-theta^2 / (2 sigma^2)), sigma in radians, > 0
///   blinn_phong       cos^N(theta/2) cos theta for theta < 90 degrees: the half vector's cosine (Blinn 1977) as engines
///                     prefilter with it, n = v = r, N >= 0
///   von_mises_fisher  exp(kappa (cos theta - 1)), kappa >= 0 (Fisher 1953): the Gaussian of the sphere
///   table             any values against the angle, scaled so that the integral is 1 (kernel_table.h)
struct ZonalKernel {
  KernelKind kind = KernelKind::lambert;
  double parameter = 0;                        ///< alpha, N, unused, sigma (rad), N, kappa, unused
  double normalization = 1;                    ///< set by the make functions
  std::shared_ptr<const KernelTable> table{};  ///< of the kind table alone
};

/// Throw Error when the parameter is out of its range.
ZonalKernel make_ggx_kernel(double alpha);
ZonalKernel make_phong_kernel(double exponent);
ZonalKernel make_lambert_kernel();
ZonalKernel make_gaussian_kernel(double sigma_radians);
ZonalKernel make_blinn_phong_kernel(double exponent);
ZonalKernel make_von_mises_fisher_kernel(double kappa);
ZonalKernel make_table_kernel(KernelTable table);

/// "ggx alpha 0.25" and the like.
std::string describe(const ZonalKernel& kernel);

/// K as a function of u = 1 - cos theta in [0, 2], which keeps full precision at narrow angles. out[i] = K(u[i]).
void evaluate(const ZonalKernel& kernel, std::span<const double> one_minus_cos, std::span<double> out);
double evaluate(const ZonalKernel& kernel, double one_minus_cos);

/// The angle (rad) over which K varies near its axis: the distance of its nearest complex singularity where it has
/// one (2 alpha for ggx), else its spread, for tables that of a Gaussian as steep. Quadratures and degrees scale with it.
double angular_width(const ZonalKernel& kernel);

/// K / cos theta just above 90 degrees, where K ends with a kink; 0 for kernels that end smoothly there.
double kink_slope(const ZonalKernel& kernel);

/// k_l = 2 pi integral of K(cos t) P_l(cos t) sin t dt, l = 0 .. max_degree: what convolution with K multiplies degree l
/// by (Funk-Hecke). k_0 = 1 exactly; error below 1e-11.
std::vector<double> legendre_coefficients(const ZonalKernel& kernel, int max_degree);

/// A kernel cut smoothly in two at near_angle (rad): core + rest = K, the core vanishing beyond near_angle, the rest
/// vanishing towards the axis. core_share falls from 1 to 0 as theta goes from 0 to near_angle, flat to the 7th
/// derivative at both ends, so that the rest is smooth at the scale of near_angle however narrow K is.
double core_share(double theta_over_near_angle);

/// The coefficients of the rest alone (k_0 < 1); near_angle > 0.
std::vector<double> legendre_coefficients_of_rest(const ZonalKernel& kernel, double near_angle,
                                                  int max_degree);

}  // namespace welkin
