#include <welkin/envmap/methods/working_cube.h>

#include <algorithm>
#include <cmath>

#include <welkin/envmap/methods/cube_texels.h>
#include <welkin/envmap/methods/kernel_quantiles.h>
#include <welkin/sphere/resample.h>

namespace welkin {

Cube working_cube(const Image& radiance, int size) {
  ResampleOptions options;
  options.interpolate = false;
  return equirect_to_cube(radiance, size, options);
}

int working_cube_size(const Image& radiance, const ZonalKernel& kernel, double texels_a_width) {
  const int finest = 4 * matching_cube_size(radiance);
  int size = 8;
  while (size < finest && 2.0 / size > angular_width(kernel) / texels_a_width) size *= 2;
  return size;
}

double kernel_spread(const ZonalKernel& kernel) {
  const double u = KernelQuantiles(kernel).one_minus_cos(1 - std::exp(-0.5));
  return 2 * std::asin(std::sqrt(std::min(1.0, 0.5 * u)));
}

}  // namespace welkin
