#pragma once
#include <vector>

#include <welkin/sphere/mapping.h>
#include <welkin/sphere/patch_mean.h>

namespace welkin {

/// The interpolation kernel over an equirectangular map's texels: which of them lie near a direction follows from
/// their rows and columns, so that nothing is sorted or stored but one sine and cosine per row and column.
class EquirectNeighbours {
 public:
  explicit EquirectNeighbours(MapShape shape);

  /// Appends the weights of all texels whose centres lie within `radius` (as a chord, between unit vectors) of a unit
  /// direction: (1 - (chord / radius)^2)^3 times their solid angle. Returns the sum of the weights.
  double append(Vec3 direction, double radius, std::vector<TexelWeight>& weights) const;

 private:
  MapShape shape_;
  std::vector<double> cos_theta_, sin_theta_, solid_angle_;  // of each row
  std::vector<double> cos_phi_, sin_phi_;                    // of each column
};

}  // namespace welkin
