#pragma once
#include <cstddef>
#include <span>

#include <welkin/image/byte_image.h>
#include <welkin/image/image.h>

namespace welkin {

/// How far A is from B, the reference. Every channel value counts the same (times its pixel's weight).
struct ImageDifference {
  double rmse = 0;  ///< sqrt(sum w (a - b)^2 / sum w)
  double relative_rmse =
      0;  ///< rmse / root mean square of B; 0 for two black images, infinite if only B is black
  double psnr_db =
      0;  ///< 20 log10(max(B) / rmse); infinite for equal images, -infinite if B has no value > 0
  double max_abs = 0;         ///< the largest |a - b|
  std::size_t max_pixel = 0;  ///< the first pixel with that difference
  int max_channel = 0;
  double max_a = 0, max_b = 0;  ///< the two values there
  std::size_t unequal_faults =
      0;  ///< values where just one is NaN, or an infinity is not matched; not in the figures
};

/// Compares `channels` interleaved values per pixel. `weights`, if any, has one value >= 0 per pixel (e.g. its solid
/// angle) and weighs the means, not the maxima. a.size() == b.size() is the caller's duty. Values where either is not
/// finite are left out of every figure; see unequal_faults. Sums are in double and in a fixed order.
ImageDifference compare_images(std::span<const float> a, std::span<const float> b, int channels,
                               std::span<const float> weights = {});

/// A picture of |a - b| relative to the root mean square of B, the largest channel of each pixel, on a logarithmic
/// scale of 8 decades: black up to 1e-6, then through blue, purple, red, orange and yellow to white at 1e2 and above; a
/// pixel that is not finite in just one of the images is green. Lightness rises evenly (CIE L* 0 to 100), so that it
/// reads in gray too. Widths, heights and channels are equal by the caller's duty.
ByteImage difference_image(const Image& a, const Image& b);

}  // namespace welkin
