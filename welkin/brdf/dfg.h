#pragma once
#include <vector>

// The view-dependent half of the split-sum approximation (Karis 2013): how much a GGX surface under a
// constant environment of radiance 1 reflects towards the viewer, with height-correlated Smith shadowing and
// Schlick's Fresnel term with f90 = 1,
//   integral of f(view, light) cos_light over the hemisphere of lights = F0 * scale + bias,
// and the light that single scattering loses. Computed by quadrature, not by sampling: integrate_dfg() is within 1e-5
// of the integral for every cos_view in [0, 1] and alpha in [1e-6, 1].

namespace welkin {

struct DfgValue {
  double scale = 0;  // of F0
  double bias = 0;

  /// What a surface with F0 = 1 reflects, the directional albedo E_ss of single scattering, in (0, 1].
  double albedo() const { return scale + bias; }
};

/// Scale and bias for `cos_view` = n.v in [0, 1] and the GGX width `alpha` in [0, 1] (0 is a mirror: Schlick
/// itself).
DfgValue integrate_dfg(double cos_view, double alpha);

/// 2 * integral of E_ss(c, alpha) c over c in [0, 1]: what the surface with F0 = 1 reflects of light that is
/// the same from everywhere, averaged over all views (Kulla & Conty 2017, E_avg). Absolute error 1e-5.
double average_albedo(double alpha);

/// The factor 1 + F0 (1 / E_ss - 1) on the specular reflection that returns the light lost between facets
/// (Turquin 2019, eq. 16; Fdez-Aguera 2019 is the same to first order). Exactly 1 / E_ss for F0 = 1: a white
/// metal in a white furnace reflects everything. Not reciprocal. `albedo` is DfgValue::albedo() for the same
/// view and alpha, > 0.
double multiple_scattering_factor(double f0, double albedo);

/// The reciprocal lobe that does the same for F0 = 1 (Kulla & Conty 2017, slide 15), per steradian:
/// (1 - E_ss(view)) (1 - E_ss(light)) / (pi (1 - E_avg)). Zero when nothing is lost (E_avg = 1).
double multiple_scattering_lobe(double albedo_view, double albedo_light, double average);

/// What the two channels of a table hold.
enum class DfgForm {
  /// (scale, bias): reflectance = F0 * R + G. Multiple scattering is left to the consumer, with E_ss = R + G.
  scale_bias,
  /// (scale, bias) of the straight line in F0 through the compensated reflectance
  /// (F0 scale + bias) (1 + F0 (1/E_ss - 1)) at F0 = 0.04 and at F0 = 1, for consumers that apply no
  /// compensation of
  /// their own. Exact for F0 = 0.04 and 1, at most 0.18 too bright between (alpha = 1, F0 = 0.5); G may be
  /// slightly
  /// below 0.
  scale_bias_with_multiple_scattering,
};

struct DfgOptions {
  int size = 128;  // texels along each axis, 1 to 4096
  DfgForm form = DfgForm::scale_bias;
};

/// A square table, row by row. Texel (i, j) holds the values at cos_view = (i + 0.5) / size and
/// perceptual_roughness = (j + 0.5) / size, alpha = its square; row 0 is the smoothest.
struct DfgTable {
  int size = 0;
  std::vector<float> scale_bias;  // R, G interleaved: 2 * size * size
};

/// Fills a table. Throws Error for a size out of range.
DfgTable make_dfg_table(const DfgOptions& options = {});

/// What a consumer sees: bilinear look-up, clamped to the edge, coordinates in [0, 1]. Against the integral, at random
/// coordinates: RMS 0.0013 for size 64, 0.0007 for 128, 0.0005 for 256. The maximum, wherever both coordinates are
/// above 0.02, is 0.008, 0.004 and 0.002; closer to cos_view = 0 it reaches 0.08 at any size, because E_ss rises to 1
/// there over a distance of alpha, within the last half texel.
DfgValue look_up_dfg(const DfgTable& table, double cos_view, double perceptual_roughness);

}  // namespace welkin
