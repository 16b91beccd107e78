#pragma once
#include <span>
#include <vector>

#include <welkin/brdf/dfg.h>
#include <welkin/envmap/reflection/split_sum.h>

// How well a few taps into a prefiltered map stand for the reflected lobe of a GGX surface, whatever the map is.
//
// A tap is a GGX prefilter kernel (zonal_kernel.h) of some roughness about some direction of the plane of incidence. The
// error that a mix of taps makes on a map of random light, the same from everywhere, whose power of degree l is C_l, is
//   E(error^2) = <f - sum w_k K_k, f - sum w_k K_k>,   <a, b> = sum over l of C_l sum over m of a_lm b_lm,
// and for two kernels about axes at an angle t, by the addition theorem,
//   <K_a, K_b> = sum over l of C_l (2l + 1) / (4 pi) k_l^a k_l^b P_l(cos t).
// C_l ~ (l + 1/2)^-p; photographs have p of about 2. Degree 0 is no part of the product: the weights add up to the
// lobe's integral, scale or bias of the split sum, so that a constant environment is exact.

namespace welkin {

/// One look-up: where, how rough, and how much of F0 and of 1 it counts.
struct StretchedTap {
  double offset = 0;  ///< direction = normalize(r + offset * (cos_view r - n)), r = view mirrored about n
  double perceptual_roughness = 0;
  double scale = 0, bias = 0;  ///< weight = F0 scale + bias
};

/// The products of the kernels that trilinear look-ups of a chain of levels really have: the levels' own, wider by the
/// interpolation between texels, blended linearly between levels. So the fit knows what the sampler does.
class TapSpace {
 public:
  /// light_power is p above.
  TapSpace(const ChainShape& chain, double light_power);

  int level_count() const { return chain_.levels; }
  /// The level that a roughness is looked up in; fractional.
  double level_of(double perceptual_roughness) const;
  /// Of the first level that is not the environment itself.
  double first_roughness() const;

  /// <K_a, K_b> of kernels of two levels; one_minus_cos is that of the angle between their axes.
  double product(double level_a, double level_b, double one_minus_cos) const;
  /// <delta, K> for all levels: a light in one direction against kernels that far away, added to out, times weight.
  void add_point_products(double one_minus_cos, double weight, std::span<double> out) const;

 private:
  ChainShape chain_;
  std::vector<double> point_product_;  // [bin][level]
  std::vector<double> product_;        // [level][level][bin]
};

/// The lobe of a GGX surface seen at one angle, in a TapSpace.
class TapLobe {
 public:
  /// cos_view and perceptual_roughness in (0, 1]. `space` must outlive the lobe.
  TapLobe(const TapSpace& space, double cos_view, double perceptual_roughness);

  /// Sets the weights of taps to the best ones, and returns the error, up to a constant of the lobe: the sum over
  /// F0 = 0.04 and 1 of <error, error> over the reflectance squared, and a penalty on negative weights.
  /// Offsets and roughnesses beyond limits are moved there first: directions stay above the horizon, and no tap is so sharp
  /// that the environment itself shows on a surface rougher than the first level. At most 6 taps.
  double solve(std::span<StretchedTap> taps) const;

  DfgValue reflectance() const { return dfg_; }

 private:
  struct Product {
    double scale = 0, bias = 0;
  };
  double angle_of(const StretchedTap& tap) const;
  Product lobe_product(double angle, double level) const;
  void limit(StretchedTap& tap) const;
  double error(std::span<const StretchedTap> taps, const std::vector<double>& gram,
               std::span<const Product> lobe, double unit) const;

  const TapSpace& space_;
  DfgValue dfg_;
  double cos_view_, sin_view_, roughness_, first_angle_, last_angle_;
  std::vector<double> scale_, bias_;  // <lobe, K>: [angle][level]
};

}  // namespace welkin
