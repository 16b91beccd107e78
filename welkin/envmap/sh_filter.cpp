#include <welkin/envmap/sh_filter.h>

#include <welkin/sh/algebra.h>
#include <welkin/sh/convolution.h>

namespace welkin {

ShCoefficients convolve(const ShCoefficients& coefficients, const ZonalKernel& kernel) {
  check_coefficients(coefficients);
  return convolve(coefficients, legendre_coefficients(kernel, coefficients.max_degree));
}

}  // namespace welkin
