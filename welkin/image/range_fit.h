#pragma once
#include <cstddef>
#include <span>

#include <welkin/image/image.h>
#include <welkin/image/packed_formats.h>

// Fitting radiance into formats that end near 65,000. A map with a sun may hold 200,000 times its mean: such
// data is stored divided by a power of two, which rounds nothing as long as the result is a normal number of
// the format.
//
// What a scale costs at the low end: a half is exact to 11 bits only down to 2^-14 = 6.1e-5; below that the
// step is a constant 2^-24 = 6e-8, and below 2^-25 is zero. With stored_scale S these limits, in radiance,
// are S times larger: S = 16 keeps 11 bits down to 1e-3 and its smallest step is 1e-6. rgb9e5 has 9 bits per
// pixel's largest channel down to 2^-16 S, then a constant step of 2^-24 S. So the scale is the smallest
// power of two >= 1 that fits; and data whose largest value is below 1/64 is scaled up instead (S < 1), so that a
// dim map keeps its digits.

namespace welkin {

/// What to do with values beyond the format's largest.
enum class RangePolicy {
  scale,  ///< store everything divided by a power of two, so that the largest finite value fits
  clip    ///< store as it is; larger values become the format's largest
};

/// The outcome of fitting a set of values into a format.
struct RangeFit {
  double stored_scale = 1;  ///< a power of two: true value = stored value * stored_scale
  std::size_t clipped =
      0;  ///< values that the format changes all the same: too large, infinite, NaN, negative (rgb9e5)
};

/// The largest magnitude among the finite values that `format` can hold (negative ones do not count for
/// rgb9e5); 0 for none. Runs on all threads.
float largest_storable(std::span<const float> values, PixelFormat format);

/// The smallest power of two >= 1 that brings `largest` (finite, >= 0) down to what `format` can hold; for the 16-bit
/// formats and 0 < largest < 1/64 the power of two that brings it up to [0.5, 1). 1 under RangePolicy::clip.
double scale_for(float largest, PixelFormat format, RangePolicy policy);

/// The scale for these values, and how many of them are clipped with it. Runs on all threads.
RangeFit choose_scale(std::span<const float> values, PixelFormat format, RangePolicy policy);

/// The one scale that fits all levels of a cube, and how many values of all levels are clipped with it.
RangeFit choose_scale(const CubeMips& cube, PixelFormat format, RangePolicy policy);

}  // namespace welkin
