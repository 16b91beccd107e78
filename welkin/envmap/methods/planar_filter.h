#pragma once
#include <functional>

#include <welkin/image/image.h>

// Filters of flat pictures by one kernel that is the same everywhere, for the methods that treat a part of the sphere
// as a picture: private to welkin/envmap/methods.

namespace welkin {

/// A square picture over [-half_width, half_width]^2 of a plane, y downwards: 4 channels, RGB times coverage, and
/// coverage: 0 for texels that show nothing, else a weight.
struct PlanePicture {
  Image texels;
  double half_width = 1;
};

/// A kernel of the plane, any scale (results are normalised), that varies over distances of `width` at its middle and
/// counts as 0 where |dx| or |dy| exceeds `reach`. `smooth`: away from its middle it varies over no less than a good
/// part of the distance from there, so that its wide parts may be summed over coarser texels.
struct PlaneKernel {
  std::function<double(double dx, double dy)> weight;
  double width = 0, reach = 0;
  bool smooth = true;
};

/// size x size weighted means over [-half_width, half_width]^2: sum of kernel times RGB over sum of kernel times
/// coverage, 3 channels; 0 where the kernel meets nothing. A smooth kernel is cut by smooth windows into a core of 24
/// texels and rings, each twice as wide and summed over texels twice as wide as the one inside it. Quick where the
/// grids of source and result repeat against each other after few texels. Same bits on any number of threads.
Image filter_plane(const PlanePicture& source, const PlaneKernel& kernel, int size, double half_width);

}  // namespace welkin
