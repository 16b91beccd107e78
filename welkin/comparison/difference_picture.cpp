#include <welkin/comparison/difference_picture.h>

#include <algorithm>
#include <cmath>

#include <welkin/realtime/viewer/false_color.h>

namespace welkin {
namespace {

constexpr std::uint8_t gray[3] = {110, 110, 110};

double luminance_of(const float* p) {
  return 0.2126 * double{p[0]} + 0.7152 * double{p[1]} + 0.0722 * double{p[2]};
}

void put_colour(std::uint8_t* out, double position) {
  const Rgb colour = false_color(signed_colors(), static_cast<float>(position));
  for (const float channel : {colour.r, colour.g, colour.b})
    *out++ = static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.0f, 1.0f)));
}

}  // namespace

ByteImage difference_picture(const Image& picture, const TruthPicture& truth, double full_scale) {
  const Image compared = compared_pixels(picture, truth);
  ByteImage result(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < compared.pixels.size(); ++i) {
    const double difference =
        luminance_of(&picture.pixels[4 * i]) - luminance_of(&truth.radiance.pixels[3 * i]);
    if (compared.pixels[i] == 1) {
      put_colour(&result.pixels[3 * i], 0.5 + 0.5 * difference / full_scale);
    } else {
      std::copy_n(gray, 3, &result.pixels[3 * i]);
    }
  }
  return result;
}

ByteImage difference_legend(int width, int height) {
  ByteImage legend(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) put_colour(legend.at(x, y), (x + 0.5) / width);
  return legend;
}

}  // namespace welkin
