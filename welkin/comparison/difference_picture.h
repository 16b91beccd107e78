#pragma once
#include <welkin/comparison/picture_errors.h>
#include <welkin/image/byte_image.h>

namespace welkin {

/// The signed difference of luminance in the colours of signed_colors(): warm where the picture is too bright, blue where
/// it is too dark, the ends at +-full_scale (radiance); gray where nothing is compared.
ByteImage difference_picture(const Image& picture, const TruthPicture& truth, double full_scale);

/// The legend of difference_picture: its colours from -full_scale at the left to +full_scale.
ByteImage difference_legend(int width, int height);

}  // namespace welkin
