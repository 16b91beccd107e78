#include <welkin/image/tonemap.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include <welkin/image/srgb.h>
#include <welkin/parallel/parallel_for.h>

namespace welkin {
namespace {

constexpr std::size_t pixels_per_chunk = 1 << 14;

double luminance(const float* pixel, int channels) {
  return channels == 1 ? double{pixel[0]} : 0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
}

struct LogSum {
  double sum = 0;
  std::size_t count = 0;
};

// Reinhard's extended curve divided by its argument: L (1 + L / white^2) / (1 + L) / L.
double reinhard_gain(double l, double white) {
  if (!(l > 0)) return 1;
  return std::isfinite(l) ? (1 + l / (white * white)) / (1 + l) : 1;
}

// Narkowicz 2015: a rational curve from 0 to 2.51 / 2.43, clamped to 1, of linear values in and linear values out.
double filmic(double x) {
  if (!(x > 0)) return 0;
  return x < 1e6 ? std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)) : 1.0;
}

// sRGB bytes by table: index i stands for the linear value (i / 4095)^2. One index is at most 0.1 of a byte step, so the
// result is the nearest byte but for values within 0.05 of a step from the middle between two.
std::array<std::uint8_t, 4096> make_byte_table() {
  std::array<std::uint8_t, 4096> table{};
  for (int i = 0; i < 4096; ++i) {
    const double root = i / 4095.0;
    table[i] = static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(root * root)));
  }
  return table;
}

std::uint8_t to_byte(double value, const std::array<std::uint8_t, 4096>& table) {
  const double clamped = value > 0 ? std::min(value, 1.0) : 0.0;
  return table[static_cast<std::size_t>(std::sqrt(clamped) * 4095 + 0.5)];
}

}  // namespace

double automatic_exposure_ev(const Image& image) {
  const std::size_t count = image.pixels.size() / image.channels;
  const auto partials = parallel_partials<LogSum>(
      count, pixels_per_chunk, [&](LogSum& partial, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const double l = luminance(image.pixels.data() + i * image.channels, image.channels);
          if (!(l > 0) || !std::isfinite(l)) continue;
          partial.sum += std::log2(l);
          ++partial.count;
        }
      });
  LogSum total;
  for (const LogSum& partial : partials) {
    total.sum += partial.sum;
    total.count += partial.count;
  }
  return total.count == 0 ? 0 : std::log2(0.18) - total.sum / static_cast<double>(total.count);
}

ByteImage tone_map(const Image& image, const ToneMapOptions& options) {
  assert((image.channels == 1 || image.channels == 3) && options.white > 0);
  static const std::array<std::uint8_t, 4096> table = make_byte_table();
  const double exposure =
      std::exp2(options.exposure_ev ? *options.exposure_ev : automatic_exposure_ev(image));
  ByteImage result(image.width, image.height, image.channels);
  const std::size_t count = image.pixels.size() / image.channels;
  parallel_for(count, pixels_per_chunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const float* pixel = image.pixels.data() + i * image.channels;
      const double l = exposure * luminance(pixel, image.channels);
      const double gain =
          options.curve == ToneCurve::reinhard ? exposure * reinhard_gain(l, options.white) : exposure;
      for (int c = 0; c < image.channels; ++c) {
        const double value = gain * pixel[c];
        result.pixels[i * image.channels + c] =
            to_byte(options.curve == ToneCurve::filmic ? filmic(value) : value, table);
      }
    }
  });
  return result;
}

}  // namespace welkin
