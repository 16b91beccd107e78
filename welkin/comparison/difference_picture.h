#pragma once
#include <welkin/comparison/picture_errors.h>
#include <welkin/image/byte_image.h>

namespace welkin {

/// The signed difference of luminance in false colour: white 0, red where the picture is too bright, blue where it is too
/// dark, full at +-full_scale (radiance) and darker up to twice that; gray where nothing is compared.
ByteImage difference_picture(const Image& picture, const TruthPicture& truth, double full_scale);

/// The colour of a difference as share of full_scale, in [-2, 2].
void difference_colour(double share, std::uint8_t (&rgb)[3]);

/// 1, 2 or 5 times a power of ten, the smallest that is not below the 99th percentile of the difference / truth_mean;
/// times truth_mean that is a full_scale for difference_picture.
double round_difference_scale(const PictureErrors& errors);

}  // namespace welkin
