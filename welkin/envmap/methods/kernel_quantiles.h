#pragma once
#include <vector>

#include <welkin/envmap/zonal_kernel.h>

namespace welkin {

/// How a kernel's energy is spread over the angle, by numbers alone, so that every kernel works: the share of it within
/// an angle of the axis, and the angle within which a share lies. Monotone; a table of cells in theta, graded from a small part
/// of angular_width, Gauss-Legendre nodes in each, linear in u = 1 - cos theta inside a cell. Good to about 1e-4.
class KernelQuantiles {
 public:
  explicit KernelQuantiles(const ZonalKernel& kernel);

  /// u = 1 - cos theta within which `share`, in [0, 1], of the energy lies.
  double one_minus_cos(double share) const;
  /// The share within u, in [0, 2].
  double share(double one_minus_cos) const;
  /// The angle (rad) beyond which no more than `share` of the energy lies; 0 < share < 1.
  double angle_with_tail(double share) const;

 private:
  std::vector<double> u_, inside_, outside_;  // edges of the cells, ascending; shares on either side of them
};

}  // namespace welkin
