#include <welkin/comparison/difference_picture.h>

#include <algorithm>
#include <cmath>

namespace welkin {

// Both hues lose the same lightness: from white to a strong colour at 1, on to a dark one at 2.
void difference_colour(double share, std::uint8_t (&rgb)[3]) {
  constexpr double red[3] = {200, 30, 30}, blue[3] = {30, 70, 200};
  const double size = std::min(std::abs(share), 2.0);
  for (int c = 0; c < 3; ++c) {
    const double strong = share > 0 ? red[c] : blue[c];
    const double value = size <= 1 ? 255 + size * (strong - 255) : strong * (1 - 0.65 * (size - 1));
    rgb[c] = static_cast<std::uint8_t>(std::lround(value));
  }
}

double round_difference_scale(const PictureErrors& errors) {
  const double wanted = std::clamp(errors.p99, 1e-6, 1e6);
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= wanted * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

ByteImage difference_picture(const Image& picture, const TruthPicture& truth, double full_scale) {
  const Image compared = compared_pixels(picture, truth);
  ByteImage result(picture.width, picture.height, 3);
  const auto luminance_of = [](const float* p) {
    return 0.2126 * double{p[0]} + 0.7152 * double{p[1]} + 0.0722 * double{p[2]};
  };
  for (std::size_t i = 0; i < compared.pixels.size(); ++i) {
    std::uint8_t rgb[3] = {150, 150, 150};
    if (compared.pixels[i] == 1)
      difference_colour((luminance_of(&picture.pixels[4 * i]) - luminance_of(&truth.radiance.pixels[3 * i])) /
                            full_scale,
                        rgb);
    std::copy_n(rgb, 3, &result.pixels[3 * i]);
  }
  return result;
}

}  // namespace welkin
