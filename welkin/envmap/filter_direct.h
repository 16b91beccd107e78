#pragma once
#include <span>
#include <vector>

#include <welkin/envmap/bright_texels.h>
#include <welkin/envmap/zonal_kernel.h>

// The parts of a filtered map that are summed texel by texel: private to welkin/envmap.

namespace welkin {

/// Bright texels laid out for fast sums: each is integrated with two nodes a side, or one where the kernel is so wide
/// that one is enough, and those too near to the direction for that by integrate_kernel.
class BrightSum {
 public:
  BrightSum(std::span<const BrightTexel> texels, const ZonalKernel& kernel);
  /// Adds scale * sum over the texels of radiance * integral of K to rgb[3].
  void add(Vec3 direction, double scale, double* rgb);

 private:
  std::span<const BrightTexel> texels_;
  ZonalKernel kernel_;
  int nodes_ = 1;                         // a texel: 1 or 4
  std::vector<double> x_, y_, z_, area_;  // [node of texel * texel count + texel]
  std::vector<double> reach_squared_;     // nearer than this (chord) the adaptive rule is needed
  std::vector<double>
      end_reach_;  // |cos| below which the texel may lie across the kernel's end at 90 degrees
  std::vector<double> one_minus_cos_, value_;
};

/// Adds scale * sum over the texels of the map, without the excess of bright ones, of radiance * integral of the kernel's core (within near_angle) to rgb[3].
void add_core(const BrightSplit& split, const ZonalKernel& kernel, double near_angle, Vec3 direction,
              double scale, double* rgb);

}  // namespace welkin
